// The page as a whole, from folders as runs leave them and as they must not be.

#include "clca/report/report.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "clca/image/png.hpp"
#include "clca/store/file.hpp"
#include "clca/store/run_folder.hpp"
#include "clca/store/summary.hpp"
#include "clca/text/input_error.hpp"
#include "support/runs.hpp"
#include "unit/report/markup.hpp"

namespace clca::report::report_test {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::ThrowsMessage;

std::size_t occurrences(const std::string& text, const std::string& what) {
  std::size_t count = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) {
    ++count;
  }
  return count;
}

/// Without what matplotlib has written.
std::string without_figures(std::string html) {
  for (std::size_t at = html.find("<svg"); at != std::string::npos; at = html.find("<svg")) {
    html.erase(at, html.find("</svg>", at) + 6 - at);
  }
  return html;
}

class Report : public ::testing::Test {
 protected:
  void SetUp() override {
    summary_.version = "0.1.0";
    summary_.scene = "small";
    summary_.title = "A small run";
    summary_.seed = 7;
    summary_.status = "done";
    summary_.stages = {{.name = "packing",
                        .steps = 20,
                        .ended = "settled",
                        .measures = {{"packing_fraction", 0.8125}, {"clogged", true}}},
                       {.name = "flow",
                        .steps = 10,
                        .ended = "settled",
                        .measures = {{"packing_fraction", 0.5}, {"unheard_of", 3.0}}}};
    write("scene.yaml", R"(clca: 1
title: A small run
box: {width: 60, height: 60}
species:
  grain: {shape: {hexagon: 1}}
stages:
  - name: packing
    fill: {region: [0, 0, 30, 60], counts: {grain: 30}}
)");
  }
  void write(const std::string& file, const std::string& text) const {
    store::write_whole(run() / file, text);
  }
  void write_frame(std::uint64_t step, const std::vector<std::uint8_t>& bytes) const {
    fs::create_directories(run() / "frames");
    std::ofstream(store::frame_path(run(), "small", step, 6), std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()),
               static_cast<std::streamsize>(bytes.size()));
  }
  static std::vector<std::uint8_t> picture() {
    const image::Image image(40, 30, {200, 100, 50});
    return image::encode_png(image, {});
  }
  fs::path run() const { return folder_.path(); }
  /// Writes run.json and the page and reads that.
  std::string page(Options options = {}) {
    write("run.json", store::to_json(summary_));
    warnings_.clear();
    options.warning = [&](const std::string& text) { warnings_.push_back(text); };
    const auto bytes = testing::bytes_of(write_report(run(), options));
    std::string html(bytes.begin(), bytes.end());
    EXPECT_EQ(testing::markup_error(without_figures(html)), "");
    return html;
  }

  testing::ScratchFolder folder_;
  store::RunSummary summary_;
  std::vector<std::string> warnings_;
};

TEST_F(Report, OfARunWithoutPicturesAndTablesHasWhatThereIs) {
  const std::string html = page();
  EXPECT_THAT(warnings_, IsEmpty());
  EXPECT_THAT(html, AllOf(HasSubstr("<h1>A small run</h1>"), HasSubstr("Packing fraction"),
                          HasSubstr("0.8125"), HasSubstr("unheard_of"),
                          HasSubstr("<td data-of=\"packing\">yes</td>"),
                          HasSubstr("clca run small.yaml --seed 7 -o small"),
                          Not(HasSubstr("id=\"pictures\"")), Not(HasSubstr("id=\"figures\""))));
  EXPECT_TRUE(fs::exists(run() / "report.html"));
}

TEST_F(Report, OfTheSameFolderIsTheSameBytesAndHoldsNoTraceOfItself) {
  const std::string first = page();
  EXPECT_EQ(first, page());
}

TEST_F(Report, NeedsNothingFromElsewhere) {
  write_frame(30, picture());
  write("series.csv", "step,stage,moving_share\n0,packing,0.5\n1,packing,0.2\n");
  const std::string html = page();
  EXPECT_THAT(html, HasSubstr("<svg"));
  EXPECT_THAT(without_figures(html),
              AllOf(Not(HasSubstr("http://")), Not(HasSubstr("https://")),
                    Not(HasSubstr("src=\"frames")), Not(HasSubstr("@import"))));
  EXPECT_THAT(html, HasSubstr("default-src 'none'"));
}

TEST_F(Report, EscapesEverythingThatComesFromFiles) {
  const std::string evil = "</pre></script><script>alert(1)</script>\"'&";
  const std::string evil_name = "<script>alert(1)<script>\"'&";
  summary_.scene = evil_name;
  summary_.title = "</title><script>alert(1)</script>";
  summary_.status = evil;
  summary_.version = evil;
  summary_.stages[0].name = evil_name;
  summary_.stages[0].ended = evil;
  summary_.stages[0].measures.emplace_back(evil, 1.0);
  write("scene.yaml",
        "clca: 1\ntitle: \"" + std::string("</title><script>alert(1)</script>") +
            "\"\nbox: {width: 60, height: 60}\nspecies:\n  a: {shape: {hexagon: 1}}\n"
            "stages:\n  - {name: b, fill: {region: [0, 0, 30, 60], counts: {a: 3}}}\n");
  write("series.csv",
        "step,stage,moving_share,travel.</script><script>alert(1)\n0,</"
        "script><script>alert(1),0.5,1\n");
  write("walls-x.csv", "wall,<script>alert(1)\n</td><script>alert(1),2\n");
  write("profile-<script>alert(1).csv", "x,height_end\n0,1\n1,2\n");
  write_frame(20, picture());
  const std::string html = page();
  EXPECT_THAT(html, Not(HasSubstr("<script>alert")));
  EXPECT_THAT(html, HasSubstr("<title>&lt;/title&gt;&lt;script&gt;"));
  EXPECT_EQ(occurrences(without_figures(html), "<script>"), 1U);
}

TEST_F(Report, LeavesOutWhatCannotBeReadAndSaysSo) {
  write("series.csv", "step,stage,moving_share,mean_height\n0,packing,0.5,1\n1,packing,x,2\n");
  write("profile-flow.csv", "x,height_end\n0,1,2\n");
  write("cycles.csv", "");
  fs::create_directories(run() / "closure.csv");
  fs::create_symlink(run() / "missing", run() / "fields.csv");
  write_frame(20, {1, 2, 3});
  const std::string html = page();
  EXPECT_THAT(warnings_,
              ::testing::IsSupersetOf(
                  {HasSubstr("series.csv: line 3: 'x' in column 'moving_share' is no number"),
                   HasSubstr("profile-flow.csv: line 2: cut off or no row of the table"),
                   HasSubstr("cycles.csv: line 1: cut off or no row of the table"),
                   HasSubstr("small-000020.png is left out: it is no PNG")}));
  EXPECT_THAT(html, AllOf(HasSubstr("is no number"), HasSubstr("Mean height of all particles"),
                          Not(HasSubstr("Share of the particles"))));
}

TEST_F(Report, OfAFolderThatIsNoRunIsRefused) {
  const auto refused = [&](const char* message) {
    EXPECT_THAT([&] { write_report(run()); }, ThrowsMessage<text::InputError>(HasSubstr(message)));
    EXPECT_FALSE(fs::exists(run() / "report.html"));
  };
  refused("run.json: No such file");
  write("run.json", "{\"clca\": ");
  refused("it is cut off or no JSON");
  summary_.kind = "comparison";
  write("run.json", store::to_json(summary_));
  refused("no report of a run of kind 'comparison'");
  fs::remove(run() / "run.json");
  fs::create_directories(run() / "run.json");
  refused("run.json: it is a folder");
}

TEST_F(Report, OfAnEarlierVersionGoesByTheNameOfTheScene) {
  summary_.title.clear();
  EXPECT_THAT(page(), HasSubstr("<h1>small</h1>"));
}

TEST_F(Report, WithoutASceneSaysSo) {
  fs::remove(run() / "scene.yaml");
  page();
  EXPECT_THAT(warnings_, ElementsAre(HasSubstr("scene.yaml: No such file")));
}

TEST_F(Report, TakesPicturesEvenlyAndTheEndsOfStages) {
  for (std::uint64_t step = 0; step <= 30; ++step) {
    write_frame(step, picture());
  }
  std::string html = page();
  EXPECT_EQ(occurrences(html, "\"step\":"), 31U);
  EXPECT_THAT(html, AllOf(HasSubstr("All 31 pictures"), HasSubstr("id=\"end-1\""),
                          HasSubstr("width=\"40\" height=\"30\""),
                          HasSubstr("End of <b>packing</b>, step 20"),
                          HasSubstr(R"({"same":"end-2","stage":"flow","step":30})")));
  html = page({.file = {}, .max_frames = 4, .warning = {}});
  EXPECT_EQ(occurrences(html, "\"step\":"), 4U);
  EXPECT_THAT(
      html, AllOf(HasSubstr("4 of 31 pictures, evenly chosen;"), HasSubstr("\"step\":0}"),
                  HasSubstr("\"step\":10}"), HasSubstr("\"step\":20}"), HasSubstr("\"step\":30}")));
  html = page({.file = {}, .max_frames = 0, .warning = {}});
  EXPECT_EQ(occurrences(html, "\"step\":"), 0U);
}

TEST_F(Report, StaysBelowTwentyMegabytesHoweverManyPicturesThereAre) {
  std::vector<std::uint8_t> large = picture();
  large.resize(40'000);
  for (std::uint64_t step = 0; step < 2000; ++step) {  // 80 MB
    write_frame(step, large);
  }
  const std::string html = page();
  EXPECT_LT(html.size(), 20U << 20U);
  EXPECT_GT(html.size(), 18U << 20U);
  EXPECT_THAT(html,
              HasSubstr(" of 2000 pictures, evenly chosen to keep this page below some 20 MB"));
}

TEST_F(Report, OfALongSeriesStaysSmall) {
  std::string series = "step,stage,moving_share,mean_height\n";
  for (int step = 0; step < 400'000; ++step) {
    series += fmt::format("{0},packing,{1},{0}\n", step, step % 7 == 0 ? "" : "0.5");
  }
  write("series.csv", series);
  EXPECT_LT(page().size(), 500'000U);
}

TEST_F(Report, HasTheFiguresThatTheTablesAllow) {
  write("series.csv", "step,stage,moving_share,mean_height\n0,flow,0.5,3\n1,flow,0.2,4\n");
  write("contacts-flow.csv",
        "first,second,x,y,sites,depth,source,mean_sites,share\n0,1,1,1,2,1,plate,1,1\n"
        "1,plate,2,3,1,1,plate,1,1\n0,5,,,0,0,,0.5,0.5\n");
  write("loads-flow.csv", "id,species,x,y,sites,pushes\n0,a,0,0,2,1\n1,a,2,2,3,1\n");
  write("convection-flow.csv", "x,y,dx,dy,weight\n1,1,0.5,0.1,3\n3,1,,,0\n");
  write("fields.csv",
        "stage,step,x,y,packing,particles,vx,vy,fluctuation\nflow,10,1,1,0.5,2,0,-1,0.1\n"
        "flow,20,1,1,0.7,2,0,-0.5,0.1\nflow,20,3,1,0.6,0,,,\n");
  const std::string html = page();
  EXPECT_THAT(warnings_, IsEmpty());
  EXPECT_EQ(occurrences(html, "<svg"), 6U);
  EXPECT_THAT(
      html, AllOf(HasSubstr("id=\"figure-motion\""), HasSubstr("id=\"figure-mean-height\""),
                  HasSubstr("id=\"figure-contacts-flow\""), HasSubstr("widest: 2 sites"),
                  HasSubstr("id=\"figure-velocity-field-flow\""), HasSubstr("mean over 2 windows"),
                  HasSubstr("id=\"figure-fluctuation-field-flow\""),
                  HasSubstr("id=\"figure-convection-flow\"")));
}

TEST_F(Report, OfAGasHasTemperaturesAndHistograms) {
  summary_.kind = "boltzmann";
  write("series.csv",
        "restitution,time,t_tr,t_tr_se,dh_tr\n0.5,0,1,0,0.1\n0.5,1,0.5,0.01,0.2\n0.9,0,1,0,0.1\n0."
        "9,1,0.9,,0.1\n");
  write("closure.csv", "restitution,time,t_tr,t_rot\n0.5,0,1,1\n0.5,1,0.4,0.6\n");
  for (const char* time : {"0", "5", "10"}) {
    write(fmt::format("histogram-{}.csv", time),
          "restitution,energy,lower,upper,share,reference\n0.5,rotational,0,2,0.5,0.4\n"
          "0.5,rotational,2,4,0.4,0.4\n0.5,rotational,4,,0.1,0.2\n");
  }
  const std::string html = page();
  EXPECT_THAT(warnings_, IsEmpty());
  EXPECT_EQ(occurrences(html, "<svg"), 3U);
  EXPECT_THAT(html,
              AllOf(HasSubstr("closed form"), HasSubstr("id=\"figure-energy-rotational-0.5\""),
                    HasSubstr("chi-square")));
  EXPECT_LT(html.find("time 5<"), html.find("time 10<"));
}

TEST_F(Report, OfARunWithUnitsIsInThese) {
  summary_.steps = 30;
  summary_.stages[1].measures = {{"outflow_sites_per_time", 5.0}, {"fluctuation_energy", 0.5}};
  write_frame(20, picture());
  write("series.csv", "step,time,stage,moving_share\n0,0,flow,0.5\n30,0.015,flow,0.2\n");
  write("fields.csv",
        "stage,step,time,x,y,packing,particles,vx,vy,fluctuation\n"
        "flow,10,0.005,1,1,0.5,2,0,-1,0.1\nflow,20,0.01,3,1,0.5,2,0,-1,0.1\n");
  const auto in_time =
      AllOf(HasSubstr("<dt>Time</dt><dd>0.0150 s</dd>"),
            HasSubstr("<td data-of=\"packing\">20 (0.0100 s) "),
            HasSubstr("End of <b>packing</b>, step 20, t = 0.0100 s"),
            HasSubstr("\"time\":\"0.0100 s\""), HasSubstr(">sites/s<"), HasSubstr(">(m/s)²<"));
  EXPECT_THAT(page(), AllOf(Not(HasSubstr("0.0150 s")), HasSubstr("(spacings/step)²")));
  summary_.units = {
      .length_unit = "m", .time_unit = "s", .velocity_unit = "m/s", .time_step = 0.0005};
  EXPECT_THAT(page(), in_time);
  EXPECT_THAT(warnings_, IsEmpty());
}

TEST_F(Report, HasMoviesAndPicturesThatWereDrawnAgain) {
  write("flow.mp4", "a movie");
  write("small.gif", "another one");
  fs::create_directories(run() / "render");
  const std::vector<std::uint8_t> bytes = picture();
  for (int step = 0; step < 300; step += 10) {
    write(fmt::format("render/small-{:06}.png", step), {bytes.begin(), bytes.end()});
  }
  const std::string html = page();
  EXPECT_THAT(
      html,
      AllOf(HasSubstr("media-src data:"), HasSubstr("src=\"data:video/mp4;base64,YSBtb3ZpZQ==\""),
            HasSubstr("src=\"data:image/gif;base64,"), HasSubstr("<code>flow.mp4</code>"),
            HasSubstr("12 of 30 pictures, evenly chosen,"),
            HasSubstr("<figcaption>step 290</figcaption>")));
  EXPECT_EQ(occurrences(html, "Picture drawn again"), 12U);
  EXPECT_THAT(warnings_, IsEmpty());
}

TEST_F(Report, LeavesOutAMovieThatIsTooLargeAndSaysSo) {
  write("flow.mp4", std::string(8 << 20, 'a'));
  EXPECT_THAT(page(), Not(HasSubstr("<video")));
  EXPECT_THAT(warnings_, ElementsAre(HasSubstr("flow.mp4")));
}

// The bed lies on a floor that is no longer level.
TEST_F(Report, LeavesOutWhatIsMeasuredAlongTheFloorOfAVesselThatIsTurned) {
  summary_.stages[0].measures = {{"repose_angle_deg", 11.5},
                                 {"vessel_angle_deg", 0.0},
                                 {"repose_gravity_deg", 12.5},
                                 {"runout_99", 13.5}};
  summary_.stages[1].measures = {{"repose_angle_deg", 21.5},
                                 {"vessel_angle_deg", 30.0},
                                 {"repose_gravity_deg", 22.5},
                                 {"runout_99", 23.5},
                                 {"segregation_index", 0.25}};
  const std::string html = page();
  for (const char* there : {"11.5", "12.5", "13.5", "22.5", "is left out"}) {
    EXPECT_THAT(html, HasSubstr(there));
  }
  for (const char* gone : {">21.5", ">23.5", "segregation_index"}) {
    EXPECT_THAT(html, Not(HasSubstr(gone)));
  }
  summary_.stages[1].measures[1].second = 0.0;
  EXPECT_THAT(page(), AllOf(HasSubstr(">21.5"), HasSubstr("segregation_index"),
                            Not(HasSubstr("is left out"))));
}

TEST_F(Report, LeavesItOutOfASweepToo) {
  write("sweep.json",
        R"({"scene": "small.yaml", "runs": 2, "set": [], "seeds": "1",
            "vary": [{"keys": ["a.tilt"], "rows": [["0"], ["0.5"]]}]})");
  write("runs.csv",
        "a.tilt,seed,status,steps,state_hash,folder,error\n0,1,done,1,a,x,\n0.5,1,done,1,b,y,\n");
  const auto sweep = [this](const std::string& angle) {
    std::string table = "a.tilt,stage,measure,mean,standard_error,low,high\n";
    for (const std::string& tilt : {std::string("0"), std::string("0.5")}) {
      table += tilt + ",flow,runout_99,1" + tilt + "25,,,\n" + tilt + ",flow,vessel_angle_deg," +
               (tilt == "0" ? angle : "30") + ",,,\n" + tilt + ",flow,time,7,,,\n";
    }
    write("measures.csv", table);
    return page();
  };
  const std::string html = sweep("0");
  EXPECT_THAT(html, AllOf(HasSubstr("<td data-of=\"a.&#8203;tilt=&#8203;0\">1025</td>"),
                          HasSubstr("<td data-of=\"a.&#8203;tilt=&#8203;0.5\">–</td>"),
                          HasSubstr("<th scope=\"col\">a.<wbr>tilt=<wbr>0.5</th>"),
                          HasSubstr("Time<small>of the stage</small>"), HasSubstr("is left out")));
  EXPECT_THAT(sweep("20"), Not(HasSubstr("runout_99")));
}

TEST_F(Report, NamesTheColumnsOfWallsAndTheirUnits) {
  summary_.kind = "contact";
  write("walls-flow.csv", "wall,contacts,force_x,force_y\nbox.floor,3,0.5,-2\n");
  const std::string html = page();
  EXPECT_THAT(html, AllOf(HasSubstr("Force on the wall, x (grain weights)"),
                          HasSubstr("Force on the wall, y (grain weights)")));
  EXPECT_THAT(html, HasSubstr("<td data-of=\"Force on the wall, y (grain weights)\">-2</td>"));
}

TEST_F(Report, ThatCannotBeWrittenLeavesNothing) {
  write("run.json", store::to_json(summary_));
  EXPECT_THROW(
      write_report(run(), {.file = run() / "none" / "page.html", .max_frames = {}, .warning = {}}),
      store::StoreError);
}

}  // namespace
}  // namespace clca::report::report_test
