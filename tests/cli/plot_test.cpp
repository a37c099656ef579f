// clca plot as a user meets it.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>

#include "clca/image/png.hpp"
#include "clca/store/file.hpp"
#include "clca/store/summary.hpp"
#include "support/program.hpp"
#include "support/runs.hpp"

namespace clca::plot_test {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

/// What a run of the Boltzmann equation leaves, small.
void write_gas(const fs::path& run, const std::string& scene) {
  fs::create_directories(run);
  store::RunSummary summary;
  summary.kind = "boltzmann";
  summary.scene = scene;
  store::write_whole(run / "run.json", store::to_json(summary));
  store::write_whole(run / "series.csv",
                     "restitution,time,t_tr,t_tr_se,t_rot,collisions,dh_rot\n"
                     "0.5,0,1,0,1,0,0.001\n0.5,1,0.5,0.01,0.7,2,0.01\n"
                     "0.9,0,1,0,1,0,0.001\n0.9,1,0.9,0.02,0.8,2.2,0.004\n");
  store::write_whole(run / "closure.csv",
                     "restitution,time,t_tr,t_rot\n0.5,0,1,1\n0.5,1,0.4,0.6\n0.9,1,0.8,0.7\n");
  store::write_whole(run / "histogram-0.csv",
                     "restitution,energy,lower,upper,share,reference\n"
                     "0.5,rotational,0,2,0.5,0.4\n0.5,rotational,2,4,0.4,0.4\n"
                     "0.5,rotational,4,,0.1,0.2\n0.9,rotational,0,2,0.6,0.4\n"
                     "0.9,rotational,2,4,0,0.4\n0.9,rotational,4,,0.4,0.2\n");
}

class PlotCommandTest : public ::testing::Test {
 protected:
  testing::ProgramResult plot(std::vector<std::string> arguments,
                              testing::ProgramSetting setting = {}) const {
    arguments.insert(arguments.begin(), "plot");
    setting.folder = folder_.path().string();
    return testing::run_program(arguments, setting);
  }
  std::vector<std::uint8_t> bytes(const fs::path& file) const {
    return testing::bytes_of(folder_.path() / file);
  }
  std::string text(const fs::path& file) const {
    const auto content = bytes(file);
    return {content.begin(), content.end()};
  }
  void expect_picture(const fs::path& file, int width, int height) const {
    const image::Image image = image::decode_png(bytes(file)).image;
    EXPECT_EQ(image.width, width);
    EXPECT_EQ(image.height, height);
    std::set<std::array<std::uint8_t, 3>> colors;
    for (int y = 0; y < image.height; ++y) {
      for (int x = 0; x < image.width; ++x) {
        const image::Rgb color = image.at(x, y);
        colors.insert({color.red, color.green, color.blue});
      }
    }
    EXPECT_GT(colors.size(), 20U) << file << " is blank";
  }
  void expect_refused(const testing::ProgramResult& result, int code,
                      const ::testing::Matcher<std::string>& message) const {
    EXPECT_EQ(result.code, code);
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_THAT(result.err, message);
    EXPECT_EQ(result.out, "");
  }

  testing::ScratchFolder folder_;
};

TEST_F(PlotCommandTest, DrawsTheFiguresThatTheTablesAllow) {
  write_gas(folder_.path() / "gas", "gas");
  const auto result = plot({"gas", "--width", "640", "--height", "400"});
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_EQ(result.err, "");
  std::string expected;
  for (const char* name :
       {"collisions", "distance-rotational", "energy-rotational-0.5", "energy-rotational-0.9",
        "temperature-ratio", "temperature-rotational", "temperature-translational"}) {
    const std::string file = std::string("gas/plots/") + name + ".png";
    expected += file + "\n";
    expect_picture(file, 640, 400);
  }
  EXPECT_EQ(result.out, expected);
}

TEST_F(PlotCommandTest, DrawsARunOfTheAutomaton) {
  std::ofstream(folder_.path() / "small.yaml") << R"(clca: 1
box: {width: 60, height: 60}
species:
  small: {shape: {hexagon: 1}}
walls:
  gate: {box: [30, 0, 31, 60]}
lines:
  depth: {from: [40, 0], to: [40, 20]}
  slanted: {from: [31, 0], to: [50, 20], parts: 4}
stages:
  - name: packing
    fill: {region: [0, 0, 30, 60], counts: {small: 30}}
  - name: flow
    remove: [gate]
output:
  series: {every: 1}
)";
  ASSERT_EQ(
      testing::run_program({"run", "small.yaml", "-o", "run"}, {.folder = folder_.path().string()})
          .code,
      0);
  EXPECT_THAT(plot({"run"}).out,
              AllOf(HasSubstr("run/plots/line-filling-flow.png\nrun/plots/line-flux-flow.png\n"
                              "run/plots/line-velocity-flow.png\n"),
                    HasSubstr("run/plots/mean-height.png\n"), HasSubstr("run/plots/motion.png\n"),
                    HasSubstr("run/plots/profile.png\n"), Not(HasSubstr("particles.png"))))
      << "none have entered or left";
  expect_picture("run/plots/line-velocity-flow.png", 960, 600);
  const image::Image profile = image::decode_png(bytes("run/plots/profile.png")).image;
  EXPECT_EQ(profile.width, 960);
  EXPECT_LT(profile.height, 600) << "as high as the bed takes at equal scales";
}

TEST_F(PlotCommandTest, DrawsEachTemplate) {
  const std::vector<std::vector<std::string>> runs = {
      {"run", "brazil-nut", "stages.packing.fill.counts={small: 200}",
       "stages.shaking.until={cycles: 3}"},
      {"run", "plate-penetration", "stages.packing.fill.counts={small: 250, large: 250}",
       "walls.plate.box=[66.5, 80, 73.5, 240]", "walls.plate.motion.distance=60"},
      {"run", "mixing", "stages.flow.until={discharged: 0.1}",
       "outlets.more={region: [0, 0, 10, 10]}", "probes={hole: [20, 6, 50, 60]}",
       "lines={hole: {from: [20, 9], to: [50, 9]}}", "sources={top: {at: [30, 300], rate: 0.01}}",
       "stages.flow.sources=[top]"},
      {"run", "collapse-contact", "output.fields={every: 50}", "box.width=200",
       "measure=[force, weight_paths]"},
      {"boltzmann", "boltzmann-shear", "boltzmann.particles=2000", "boltzmann.until=2",
       "output.histograms=[0, 2]"}};
  std::vector<std::string> drawn;
  for (const std::vector<std::string>& run : runs) {
    const std::string& scene = run[1];
    std::vector<std::string> command = {run[0], CLCA_SOURCE_DIR "/scenes/" + scene + ".yaml", "-o",
                                        scene};
    const auto set = [&command](const std::string& value) {
      command.insert(command.end(), {"--set", value});
    };
    std::for_each(run.begin() + 2, run.end(), set);
    if (run[0] == "run") {
      set("output.frames=none");
    }
    const auto ran = testing::run_program(command, {.folder = folder_.path().string()});
    ASSERT_EQ(ran.code, 0) << ran.err;
    const auto result = plot({scene, "--format", "svg"});
    EXPECT_EQ(result.code, 0) << result.err;
    std::istringstream lines(result.out);
    for (std::string line; std::getline(lines, line);) {
      drawn.push_back(fs::path(line).filename().string());
    }
  }
  // Other commands draw these: chosen columns, sweeps, compare.
  const std::set<std::string> others = {"style", "columns", "means", "sweep", "comparison"};
  std::vector<std::string> templates;
  for (const auto& entry : fs::directory_iterator(CLCA_SOURCE_DIR "/plots")) {
    const std::string name = entry.path().stem().string();
    if (entry.path().extension() == ".gp" && !others.contains(name)) {
      templates.push_back(name);
    }
  }
  // Longest first: `outflow-apart` is no figure of `outflow`.
  std::sort(templates.begin(), templates.end(),
            [](const auto& one, const auto& other) { return one.size() > other.size(); });
  for (const std::string& name : templates) {
    const auto is_of = [&name](const std::string& file) {
      return file.starts_with(name) && (file[name.size()] == '.' || file[name.size()] == '-');
    };
    EXPECT_GT(std::erase_if(drawn, is_of), 0U) << name;
  }
  EXPECT_THAT(drawn, ::testing::IsEmpty());
}

TEST_F(PlotCommandTest, DrawsVectorsOfTheSameSize) {
  write_gas(folder_.path() / "gas", "gas");
  const auto file_of = [&](const char* format) {
    const auto result = plot(
        {"gas", "--only", "collisions", "--format", format, "--width", "480", "--height", "300"});
    EXPECT_EQ(result.out, fmt::format("gas/plots/collisions.{}\n", format));
    return text(fmt::format("gas/plots/collisions.{}", format));
  };
  EXPECT_THAT(file_of("svg"), AllOf(HasSubstr("viewBox=\"0 0 480 300\""), HasSubstr("</svg>")));
  EXPECT_THAT(file_of("pdf"), AllOf(StartsWith("%PDF-"), HasSubstr("/MediaBox [ 0 0 360 225 ]")));
}

TEST_F(PlotCommandTest, LengthsOnPaperHaveThreeHundredDotsInAnInch) {
  write_gas(folder_.path() / "gas", "gas");
  EXPECT_EQ(plot({"gas", "--only", "collisions", "--width", "89mm"}).code, 0);
  expect_picture("gas/plots/collisions.png", 1051, 788);
  EXPECT_EQ(plot({"gas", "--only", "collisions", "--width", "89mm", "--height", "60mm"}).code, 0);
  expect_picture("gas/plots/collisions.png", 1051, 709);
  ASSERT_EQ(plot({"gas", "--only", "collisions", "--width", "89mm", "--format", "pdf"}).code, 0);
  EXPECT_THAT(text("gas/plots/collisions.pdf"), HasSubstr("/MediaBox [ 0 0 252"));
  expect_refused(plot({"gas", "--width", "89mm", "--height", "300"}), 2,
                 HasSubstr("--width and --height: both in pixels, or both in mm"));
  for (const char* width : {"89", "89cm", "5mm", "089mm", "8.9"}) {
    expect_refused(plot({"gas", "--width", width}), 2,
                   HasSubstr("expected a whole number of pixels from 100 to 10000, or 20mm to"));
  }
}

TEST_F(PlotCommandTest, DrawsColumnsAndAxesThatAreChosen) {
  write_gas(folder_.path() / "gas", "gas");
  EXPECT_EQ(plot({"gas", "--y", "t_rot,t_tr", "--log", "y"}).out,
            "gas/plots/t_rot.png\ngas/plots/t_tr.png\n");
  EXPECT_EQ(plot({"gas", "--y", "t_rot", "--x", "t_tr", "--log", "xy"}).code, 0);
  expect_picture("gas/plots/t_rot.png", 960, 600);
  expect_refused(plot({"gas", "--y", "t_rott"}), 2, HasSubstr("did you mean 't_rot'?"));
  expect_refused(plot({"gas", "--log", "z"}), 2, HasSubstr("--log"));
}

TEST_F(PlotCommandTest, DrawsASweepOnLogarithmicAxesWithErrorsOnBoth) {
  const fs::path sweep = folder_.path() / "sweep";
  fs::create_directories(sweep);
  store::write_whole(sweep / "sweep.json", R"({"title": "Collapse"})");
  store::write_whole(sweep / "measures.csv",
                     "a,model,stage,measure,mean,standard_deviation,standard_error,runs,min,max,"
                     "low,high\n"
                     "1,automaton,flow,runout_99,10,1,1,4,9,11,-1,11\n"
                     "1,automaton,flow,moved_share,0.5,1,1,4,0,1,0.4,0.6\n"
                     "2,automaton,flow,runout_99,40,1,1,4,9,11,38,42\n"
                     "2,automaton,flow,moved_share,0.7,1,1,4,0,1,0.6,0.8\n"
                     "2,contact,flow,runout_99,0,1,1,4,9,11,0,0\n");
  for (const char* axes : {"x", "y", "xy"}) {
    const auto result = plot({"sweep", "--y", "runout_99", "--over", "model", "--log", axes});
    EXPECT_EQ(result.out, "sweep/plots/sweep-flow-runout_99.png\n") << result.err;
  }
  EXPECT_EQ(plot({"sweep", "--y", "runout_99", "--x", "moved_share", "--width", "89mm"}).code, 0);
  expect_picture("sweep/plots/sweep-flow-runout_99.png", 1051, 788);
  expect_refused(plot({"sweep", "--y", "runout"}), 2,
                 HasSubstr("no measure 'runout'; did you mean 'runout_99'?"));
}

TEST_F(PlotCommandTest, FormatsAreWordsInAnyCaseAndNoNumbers) {
  EXPECT_THAT(plot({"--help"}).out, HasSubstr("--format FORMAT:{png,svg,pdf}=png\n"));
  write_gas(folder_.path() / "gas", "gas");
  EXPECT_EQ(plot({"gas", "--only", "collisions", "--format", "SVG"}).out,
            "gas/plots/collisions.svg\n");
  for (const std::string word : {"gif", "1", "sv"}) {
    expect_refused(plot({"gas", "--format", word}), 2,
                   "clca: error: --format: " + word + " not in {png,svg,pdf} (see clca --help)\n");
  }
}

TEST_F(PlotCommandTest, TheSameTablesGiveTheSameBytes) {
  write_gas(folder_.path() / "gas", "gas");
  plot({"gas", "-o", "a", "--only", "energy-rotational"});
  plot({"gas", "-o", "b", "--only", "energy-rotational"});
  for (const char* name : {"energy-rotational-0.5.png", "energy-rotational-0.9.png"}) {
    EXPECT_EQ(bytes(fs::path("a") / name), bytes(fs::path("b") / name));
  }
}

TEST_F(PlotCommandTest, NamesOfFoldersAndScenesMayHoldAnySign) {
  const std::string odd = "it's \"odd\" \\ `touch bad` $(touch bad) @x %d {a}^2 é\n;";
  std::string scene = "the " + odd;
  std::erase(scene, '\n');
  write_gas(folder_.path() / odd, scene);
  const auto result = plot({odd, "--only", "collisions", "-o", odd + "/out"});
  EXPECT_EQ(result.code, 0) << result.err;
  expect_picture(odd + "/out/collisions.png", 960, 600);
  EXPECT_FALSE(fs::exists(folder_.path() / "bad"));
  EXPECT_FALSE(fs::exists(folder_.path() / odd / "bad"));
}

TEST_F(PlotCommandTest, TextThatBeginsWithAnApostropheStandsInTheFigureAsItIs) {
  write_gas(folder_.path() / "'gas", "'Fast' 2_1 heap");
  EXPECT_EQ(plot({"'gas", "--only", "collisions", "--format", "svg"}).err, "");
  EXPECT_THAT(text("'gas/plots/collisions.svg"), HasSubstr("<text>'Fast' 2_1 heap</text>"));
}

TEST_F(PlotCommandTest, ATitleThatEndsASectionStaysTextOfAWellFormedFigure) {
  write_gas(folder_.path() / "gas", "gas");
  store::RunSummary summary = store::read_summary(folder_.path() / "gas/run.json");
  summary.title = "]]><script>alert(1)</script>]]>";
  store::write_whole(folder_.path() / "gas/run.json", store::to_json(summary));
  EXPECT_EQ(plot({"gas", "--only", "collisions", "--format", "svg"}).err, "");
  const std::string figure = text("gas/plots/collisions.svg");
  EXPECT_THAT(figure, HasSubstr("<text>]]&gt;&lt;script>alert(1)&lt;/script>]]&gt;</text>"));
  std::string outside;  // of sections, where XML has no "]]>"
  for (std::size_t at = 0; at < figure.size();) {
    const std::size_t section = std::min(figure.find("<![CDATA[", at), figure.size());
    outside += figure.substr(at, section - at);
    at = section == figure.size() ? section : figure.find("]]>", section) + 3;
  }
  EXPECT_THAT(outside, Not(HasSubstr("]]>")));
}

TEST_F(PlotCommandTest, ValuesOfASweepStandUnderTheAxisAsTheyAre) {
  fs::create_directories(folder_.path() / "'sweep");
  store::write_whole(folder_.path() / "'sweep/sweep.json", "{}");
  store::write_whole(
      folder_.path() / "'sweep/measures.csv",
      "title,rules.ties,stage,measure,mean,standard_deviation,standard_error,runs,min,max,low,"
      "high\n'Fast' 5% {x}_1,'a,flow,slope,40,1,1,4,39,41,39,41\n"
      "'2nd,b,flow,slope,41,1,1,4,39,41,40,42\n'2nd,'a,flow,slope,42,1,1,4,39,41,41,43\n");
  const auto result = plot({"'sweep", "--format", "svg"});
  EXPECT_EQ(result.err, "");
  EXPECT_EQ(result.out, "'sweep/plots/sweep-flow-slope.svg\n");
  const std::string figure = text("'sweep/plots/sweep-flow-slope.svg");
  for (const char* words : {"'Fast' 5% {x}_1", "'2nd", "'sweep, flow", "rules.ties='a"}) {
    EXPECT_THAT(figure, HasSubstr(std::string("<text>") + words + "</text>"));
  }
}

TEST_F(PlotCommandTest, WithoutGnuplotItSaysWhatToInstall) {
  write_gas(folder_.path() / "gas", "gas");
  const std::string missing = folder_.path() / "missing";
  for (const std::string& path : {std::string(), missing, std::string(".")}) {
    expect_refused(plot({"gas"}, {.environment = {{"PATH", path}}}), 1,
                   StartsWith("clca: error: gnuplot not found; install gnuplot-nox"));
  }
  EXPECT_FALSE(fs::exists(folder_.path() / "gas/plots"));
}

TEST_F(PlotCommandTest, WhenGnuplotFailsItsComplaintIsPassedOnAndNothingIsWritten) {
  write_gas(folder_.path() / "gas", "gas");
  fs::create_directories(folder_.path() / "bin");
  const auto expect = [&](const std::string& program, const std::string& message) {
    const fs::path file = folder_.path() / "bin/gnuplot";
    std::ofstream(file) << "#!/bin/sh\n" << program;
    fs::permissions(file, fs::perms::owner_all);
    expect_refused(plot({"gas"}, {.environment = {{"PATH", file.parent_path().string()}}}), 1,
                   HasSubstr(message));
    EXPECT_FALSE(fs::exists(folder_.path() / "gas/plots"));
  };
  expect("echo >&2\necho 'plot x(' >&2\necho '\"a.gp\" line 3: no x' >&2\nexit 1\n",
         "collisions: gnuplot fails with exit code 1: \"a.gp\" line 3: no x");
  expect("echo 'no such library' >&2\nexit 127\n", "exit code 127: no such library");
  expect("kill -9 $$\n", "exit code 137");
  expect("exit 0\n", "gnuplot leaves no whole picture");
  expect("printf '\\211PNG\\r\\n\\032\\ncut off before its end'\n", "no whole picture");
}

TEST_F(PlotCommandTest, WrongFoldersTablesAndNamesAreOneLineAndExitCodeTwo) {
  expect_refused(plot({"none"}), 2, HasSubstr("none/run.json: No such file"));
  fs::create_directories(folder_.path() / "empty");
  store::RunSummary summary;
  summary.scene = "empty";
  store::write_whole(folder_.path() / "empty/run.json", store::to_json(summary));
  expect_refused(plot({"empty"}), 2, HasSubstr("empty: no tables that a figure could be drawn"));
  write_gas(folder_.path() / "gas", "gas");
  expect_refused(plot({"gas", "--only", "moon"}), 2, HasSubstr("no figure 'moon' (there are: c"));
  expect_refused(plot({"gas", "--only", "stress"}), 2, HasSubstr("needs series.csv: time, p_xx"));
  expect_refused(plot({"gas", "--width", "5"}), 2, HasSubstr("--width"));
  store::write_whole(folder_.path() / "gas/closure.csv", "time,t_tr\n0,1,2\n");
  expect_refused(plot({"gas"}), 2, HasSubstr("closure.csv: line 2: 3 cells in 2 columns"));
}

TEST_F(PlotCommandTest, AFolderThatCannotBeWrittenIsOneLineAndExitCodeOne) {
  write_gas(folder_.path() / "gas", "gas");
  expect_refused(plot({"gas", "-o", "gas/run.json/x"}), 1,
                 HasSubstr("cannot write to gas/run.json/x"));
}

TEST_F(PlotCommandTest, AContactAcrossAPeriodicBoundaryIsDrawnToOneSideAndOnFromTheOther) {
  const fs::path run = folder_.path() / "run";
  fs::create_directories(run);
  store::RunSummary summary;
  summary.scene = "round";
  summary.box = {.left = -0.5, .right = 19.5, .floor = -0.5, .top = 20, .periodic = true};
  store::write_whole(run / "run.json", store::to_json(summary));
  store::write_whole(run / "loads-flow.csv", "id,x,y\n0,1,1\n1,17,5\n2,10,9\n");
  store::write_whole(run / "contacts-flow.csv",  // the last with a wall
                     "first,second,x,y,normal_force\n0,1,19,3,1\n1,2,13,7,1\n2,1b,9,8,1\n");
  ASSERT_EQ(plot({"run", "--only", "contacts-flow", "--format", "svg", "-o", "."}).code, 0);
  const std::vector<std::uint8_t> bytes = this->bytes("contacts-flow.svg");
  const std::string svg(bytes.begin(), bytes.end());
  const std::regex path(R"(stroke='rgb\(213,  94,   0\)' +d='([^']*)')");
  const std::regex point(R"(([ML])([\d.]+),)");
  const auto number = [&](const std::string& name) {
    std::smatch found;
    std::regex_search(svg, found, std::regex(name + R"( = ([-\d.]+);)"));
    return std::stod(found[1]);
  };
  const double left = number("plot_xmin");
  const double unit = (number("plot_xmax") - left) / 20;
  EXPECT_NEAR(number("plot_axis_xmin"), -0.5, 1e-9);
  EXPECT_NEAR(number("plot_axis_xmax"), 19.5, 1e-9);
  std::vector<std::pair<double, double>> lines;  // x from and to
  const std::sregex_iterator end;
  for (std::sregex_iterator drawn(svg.begin(), svg.end(), path); drawn != end; ++drawn) {
    const std::string points = (*drawn)[1];
    double from = 0;
    for (std::sregex_iterator it(points.begin(), points.end(), point); it != end; ++it) {
      const double to = (std::stod((*it)[2]) - left) / unit - 0.5;
      if ((*it)[1] == "L") {
        lines.emplace_back(from, to);
      }
      from = to;
    }
  }
  const auto line = [](double from, double to) {
    return ::testing::Pair(::testing::DoubleNear(from, 0.05), ::testing::DoubleNear(to, 0.05));
  };
  EXPECT_THAT(lines, ::testing::UnorderedElementsAre(line(1, -0.5), line(17, 19.5), line(17, 10),
                                                     line(10, 9)));
}

}  // namespace
}  // namespace clca::plot_test
