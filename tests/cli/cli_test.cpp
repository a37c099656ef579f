// The program as a user meets it.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "clca/image/png.hpp"
#include "clca/store/file.hpp"
#include "support/program.hpp"
#include "support/runs.hpp"
#include "support/sanitizers.hpp"

namespace clca::cli_test {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr const char* kScene = R"(clca: 1
seed: 5
box: {width: 60, height: 60}
species:
  small: {shape: {hexagon: 1}}
walls:
  gate: {box: [30, 0, 31, 60]}
stages:
  - name: packing
    fill: {region: [0, 0, 30, 60], counts: {small: 30}}
  - name: flow
    remove: [gate]
output:
  frames: {every: 20, width: 160, height: 120}
  series: {every: 1}
)";

/// A particle gas that never rests.
constexpr const char* kEndless = R"(clca: 1
box: {width: 60, height: 60}
species:
  small: {shape: {hexagon: 1}}
rules: {candidates: all}
stages:
  - name: gas
    fill: {region: [0, 0, 60, 60], counts: {small: 100}}
    max_steps: 1000000000000
output:
  series: {every: 1000}
  checkpoint: {every: 1000}
)";

class CliTest : public ::testing::Test {
 protected:
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_.path() / name) << text;
  }
  testing::ProgramResult run(const std::vector<std::string>& arguments,
                             testing::ProgramSetting setting = {}) const {
    setting.folder = folder_.path().string();
    return testing::run_program(arguments, setting);
  }
  nlohmann::json summary(const std::string& run) const {
    return nlohmann::json::parse(testing::bytes_of(folder_.path() / run / "run.json"));
  }
  /// Checks that the call is refused with one line on standard error, and nothing else.
  void expect_refused(const testing::ProgramResult& result, int code,
                      const ::testing::Matcher<std::string>& message) const {
    EXPECT_EQ(result.code, code);
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_THAT(result.err, message);
    EXPECT_EQ(result.out, "");
    EXPECT_FALSE(fs::exists(folder_.path() / "renders"));
  }

  testing::ScratchFolder folder_;
};

TEST_F(CliTest, ExplainsTheKeysOfAScene) {
  const auto known = run({"explain", "rules.inertia"});
  EXPECT_EQ(known.code, 0) << known.err;
  EXPECT_THAT(known.out, ::testing::StartsWith("rules.inertia: "));
  EXPECT_EQ(run({"explain", "--format", "schema"}).code, 0);
  EXPECT_EQ(run({"explain", "species", "box", "--format", "markdown"}).code, 0);
  const auto unknown = run({"explain", "rules.inerta"});
  EXPECT_EQ(unknown.code, 2);
  EXPECT_EQ(
      unknown.err,
      "clca: error: the scene format has no key 'rules.inerta'; did you mean 'rules.inertia'?\n");
}

TEST_F(CliTest, ARunBeginsWithTheEndOfAnother) {
  write("small.yaml", kScene);
  fs::create_directory(folder_.path() / "scenes");
  write("scenes/more.yaml",
        "clca: 1\nbox: {width: 80, height: 60}\nspecies: {small: {shape: {hexagon: 1}}}\n"
        "rules: {gravity: up}\nstages: [{name: up}]\noutput: {}\n");
  EXPECT_EQ(run({"run", "small.yaml", "-o", "first", "--frames-every", "0"}).code, 0);
  const auto result = run({"run", "scenes/more.yaml", "--begin", "first", "-o", "second"});
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_THAT(result.out, StartsWith("done: 30 particles, "));
  EXPECT_EQ(summary("second")["begin"]["state_hash"], summary("first")["state_hash"]);
  EXPECT_THAT(run({"check", "scenes/more.yaml", "--begin", "first"}).out,
              HasSubstr(" sites, up to 30 particles, "));
  const auto refused = run({"check", "scenes/more.yaml", "--begin", "third"});
  EXPECT_EQ(refused.code, 2);
  EXPECT_THAT(refused.err, HasSubstr("third/run.json: No such file or directory\n"));
}

TEST_F(CliTest, OpenGlIsLoadedForPolygonsOnly) {
  write("small.yaml", kScene);
  fs::create_directory(folder_.path() / "lib");
  write("lib/libOSMesa.so.8", "no library");
  write("lib/libEGL.so.1", "no library");
  const testing::ProgramSetting broken = {
      .environment = {{"LD_LIBRARY_PATH", (folder_.path() / "lib").string()}}};
  expect_refused(run({"run", "small.yaml", "--set", "output.frames.drawing=polygons"}, broken), 2,
                 AllOf(StartsWith("small.yaml:14:11: error: nothing here draws polygons: "),
                       HasSubstr("libOSMesa.so.8"), HasSubstr("libEGL.so.1")));
  const auto looked_up = run({"run", "small.yaml", "-o", "out"}, broken);
  EXPECT_EQ(looked_up.code, 0) << looked_up.err;
}

TEST_F(CliTest, PolygonsAreDrawnByEglWhereThereIsNoOsMesa) {
  write("small.yaml", kScene);
  fs::create_directory(folder_.path() / "lib");
  write("lib/libOSMesa.so.8", "no library");
  const testing::ProgramSetting broken = {
      .environment = {{"LD_LIBRARY_PATH", (folder_.path() / "lib").string()}}};
  const std::string polygons = "output.frames.drawing=polygons";
  EXPECT_EQ(run({"run", "small.yaml", "-o", "osmesa", "--set", polygons}).code, 0);
  const auto result = run({"run", "small.yaml", "-o", "egl", "--set", polygons}, broken);
  EXPECT_EQ(result.code, 0) << result.err;
  for (const auto& frame : fs::directory_iterator(folder_.path() / "osmesa" / "frames")) {
    EXPECT_EQ(testing::bytes_of(folder_.path() / "egl" / "frames" / frame.path().filename()),
              testing::bytes_of(frame.path()));
  }
}

TEST_F(CliTest, HelpNamesTheCommandsAndTheExitCodes) {
  const auto help = run({"--help"});
  EXPECT_EQ(help.code, 0);
  EXPECT_THAT(help.out, AllOf(HasSubstr("run"), HasSubstr("sweep"), HasSubstr("check"),
                              HasSubstr("diff"), HasSubstr("Exit codes")));
  EXPECT_THAT(run({"run", "--help"}).out, AllOf(HasSubstr("--set"), HasSubstr("--threads")));
  EXPECT_THAT(run({"--version"}).out, StartsWith("clca "));
  EXPECT_EQ(run({"-V"}).out, run({"--version"}).out);
  EXPECT_EQ(run({"help"}).out, help.out);
  EXPECT_EQ(run({"help", "run"}).out, run({"run", "--help"}).out);
}

TEST_F(CliTest, AnUnknownCommandIsNamedWithTheNearestOne) {
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"rum", "a.yaml"}, {"help", "rum"}}) {
    const auto result = run(arguments);
    EXPECT_EQ(result.code, 2);
    EXPECT_EQ(result.err, "clca: error: no command 'rum'; did you mean 'run'? (see clca --help)\n");
  }
}

TEST_F(CliTest, AnUnknownOptionIsNamedWithOrWithoutACommand) {
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"--no"}, {"run", "a.yaml", "--no"}, {"--no", "run", "a.yaml"}}) {
    const auto result = run(arguments);
    EXPECT_EQ(result.code, 2);
    EXPECT_EQ(result.err, "clca: error: '--no' was not expected (see clca --help)\n");
  }
  EXPECT_THAT(run({"run", "a.yaml", "--seeed", "3"}).err,
              HasSubstr("'--seeed' was not expected; did you mean '--seed'?"));
}

TEST_F(CliTest, TheHelpOfEachCommandIsPlainText) {
  const std::string all = run({"--help"}).out;
  std::istringstream lines(all.substr(all.find("Subcommands:")));
  int commands = 0;
  for (std::string line; std::getline(lines, line) && !line.starts_with("Exit codes");) {
    std::string command;
    if (!line.starts_with("  ") || line.starts_with("   ") ||
        !(std::istringstream(line) >> command)) {
      continue;
    }
    const std::string help = run({command, "--help"}).out;
    EXPECT_THAT(help, HasSubstr("Usage: clca " + (command == "help" ? "[OPTIONS]" : command)));
    EXPECT_TRUE(std::none_of(help.begin(), help.end(), [](unsigned char letter) {
      return letter != '\n' && std::iscntrl(letter) != 0;
    })) << command;
    EXPECT_THAT(help, ::testing::Not(HasSubstr("->"))) << "words and the numbers they stand for";
    ++commands;
  }
  EXPECT_GE(commands, 13);
}

TEST_F(CliTest, ExplainsAQuantityOfARun) {
  const auto result = run({"explain", "runout_99"});
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_THAT(result.out, AllOf(StartsWith("runout_99: Run-out of 99 %: "), HasSubstr("spacings"),
                                HasSubstr("run.json")));
  const auto several = run({"explain", "low"});
  EXPECT_THAT(several.out, AllOf(HasSubstr("\n  in forces-STAGE.csv\n"),
                                 HasSubstr("\n  in measures.csv of a sweep\n")));
  EXPECT_THAT(run({"explain", "seed"}).out,
              AllOf(StartsWith("seed: seed of all draws"), HasSubstr("in runs.csv of a sweep")));
  const auto unknown = run({"explain", "runnout_99"});
  EXPECT_EQ(unknown.code, 2);
  EXPECT_EQ(unknown.err,
            "clca: error: the scene format has no key 'runnout_99'; there is a quantity "
            "'runout_99'\n");
}

TEST_F(CliTest, ExplainsAQuantityInTheUnitsOfAScene) {
  EXPECT_THAT(run({"explain", "vx", "--scene", "silo-beverloo"}).out, HasSubstr("; in m/s\n"));
  EXPECT_THAT(run({"explain", "vx"}).out, HasSubstr("; in spacings/step\n"));
}

TEST_F(CliTest, ExplainsWhatASceneDerives) {
  const auto result = run({"explain", "runout_ratio", "--scene", "collapse-aspect"});
  EXPECT_EQ(result.out,
            "runout_ratio: Run-out over width of the column: =runout_99 / 40\n"
            "  in run.json: the scene derives it\n")
      << result.err;
  EXPECT_THAT(run({"explain", "--scene", "collapse-aspect"}).out,
              AllOf(StartsWith("a: "), HasSubstr("\nrunout_ratio: ")));
  EXPECT_THAT(run({"explain", "runout_rato", "--scene", "collapse-aspect"}).err,
              HasSubstr("there is a quantity 'runout_ratio'"));
}

TEST_F(CliTest, AnInstalledSceneIsFoundByThePathThatDocumentsSay) {
  EXPECT_EQ(run({"check", "scenes/collapse-aspect.yaml"}).out,
            run({"check", "collapse-aspect"}).out);
  EXPECT_THAT(run({"check", "scenes/nosuch.yaml"}).err,
              StartsWith("scenes/nosuch.yaml:1:1: error: cannot read the file"));
}

TEST_F(CliTest, ASettingWithoutItsEqualsSignIsToldSo) {
  for (const std::string option : {"--set", "--vary"}) {
    const auto result = run({"sweep", "wall-removal", option, "rules.inertia", "0.5"});
    EXPECT_EQ(result.code, 2);
    EXPECT_THAT(result.err,
                AllOf(HasSubstr(option + ": expected KEY="), HasSubstr("found 'rules.inertia'")));
  }
}

TEST_F(CliTest, AFolderThatIsNoRunIsCalledSo) {
  write("small.yaml", kScene);
  for (const char* command : {"plot", "render", "report", "export"}) {
    std::vector<std::string> arguments = {command, "."};
    if (command == std::string("export")) {
      arguments.insert(arguments.end(), {"--format", "xyz"});
    }
    const auto result = run(arguments);
    EXPECT_EQ(result.code, 2) << command;
    EXPECT_THAT(result.err, HasSubstr("is not the folder of a run")) << command;
  }
}

TEST_F(CliTest, WithoutPicturesTheirSettingsStayForLater) {
  std::string scene = kScene;
  scene.replace(scene.find("  series"), 0, "  trajectory: {every: 20}\n");
  write("small.yaml", scene);
  EXPECT_EQ(run({"run", "small.yaml", "-o", "with"}).code, 0);
  EXPECT_EQ(run({"run", "small.yaml", "-o", "without", "--frames-every", "0"}).code, 0);
  EXPECT_FALSE(fs::exists(folder_.path() / "without" / "frames"));
  EXPECT_EQ(testing::bytes_of(folder_.path() / "with" / "scene.yaml"),
            testing::bytes_of(folder_.path() / "without" / "scene.yaml"));
  const auto render = run({"render", "without"});
  EXPECT_EQ(render.code, 0) << render.err;
  for (const auto& frame : fs::directory_iterator(folder_.path() / "with" / "frames")) {
    EXPECT_EQ(testing::bytes_of(frame.path()),
              testing::bytes_of(folder_.path() / "without" / "render" / frame.path().filename()));
  }
}

TEST_F(CliTest, PicturesOfALongRunAreListedInTheOrderOfTheirSteps) {
  write("long.yaml",
        "clca: 1\nbox: {width: 10, height: 10}\nspecies: {small: {shape: {hexagon: 0}}}\n"
        "stages: [{name: rest, fill: {region: [0, 0, 10, 2], counts: {small: 1}}, "
        "until: {steps: 1200000}}]\noutput: {frames: {every: 400000, width: 64, height: 64}}\n");
  EXPECT_EQ(run({"run", "long.yaml", "-o", "out"}).code, 0);
  std::vector<std::string> names;
  for (const auto& frame : fs::directory_iterator(folder_.path() / "out" / "frames")) {
    names.push_back(frame.path().filename());
  }
  std::sort(names.begin(), names.end());
  EXPECT_THAT(names, ::testing::ElementsAre("long-0000000.png", "long-0400000.png",
                                            "long-0800000.png", "long-1200000.png"));
}

// A comma for the decimal point, as in Germany. The locale is made here, as few machines have one.
TEST_F(CliTest, NumbersAreTheSameWithADecimalComma) {
  write("comma",
        "comment_char %\nescape_char /\nLC_NUMERIC\ndecimal_point \",\"\n"
        "thousands_sep \".\"\ngrouping 3;3\nEND LC_NUMERIC\n");
  testing::run_program({"-c", "-i", "comma", "./comma_XX"},
                       {.folder = folder_.path().string(), .program = "/usr/bin/localedef"});
  const testing::ProgramSetting comma = {
      .environment = {{"LOCPATH", folder_.path().string()}, {"LC_ALL", "comma_XX"}}};
  testing::ProgramSetting printf = comma;
  printf.program = "/usr/bin/printf";
  ASSERT_EQ(run({"%.1f", "1,5"}, printf).out, "1,5");
  std::string scene = kScene;
  write("small.yaml",
        scene + "  fields: {cell: 7.5}\nlet: {third: =1/3}\nrules: {inertia: =third*1.5}\n");
  EXPECT_EQ(run({"check", "small.yaml"}, comma).out, run({"check", "small.yaml"}).out);
  EXPECT_EQ(run({"run", "small.yaml", "-o", "point"}).code, 0);
  const auto result = run({"run", "small.yaml", "-o", "comma_run"}, comma);
  EXPECT_EQ(result.code, 0) << result.err;
  for (const char* file : {"scene.yaml", "series.csv", "fields.csv", "profile-flow.csv"}) {
    EXPECT_EQ(testing::bytes_of(folder_.path() / "point" / file),
              testing::bytes_of(folder_.path() / "comma_run" / file))
        << file;
  }
  EXPECT_EQ(summary("point")["state_hash"], summary("comma_run")["state_hash"]);
}

TEST_F(CliTest, AFolderThatCannotBeLockedIsAFailureOfRunAndResume) {
  write("small.yaml", kScene);
  EXPECT_EQ(run({"run", "small.yaml", "-o", "out"}).code, 0);
  fs::remove(folder_.path() / "out" / ".clca.lock");
  fs::create_directory(folder_.path() / "out" / ".clca.lock");
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"run", "small.yaml", "-o", "out"}, {"resume", "out"}}) {
    const auto result = run(arguments);
    EXPECT_EQ(result.code, 1);
    EXPECT_THAT(result.err, HasSubstr("cannot lock out/.clca.lock"));
  }
}

TEST_F(CliTest, ResumingADoneRunPrintsWhatIsAskedFor) {
  write("small.yaml", kScene);
  const auto done = run({"run", "small.yaml", "-o", "out", "--json"});
  EXPECT_EQ(run({"resume", "out", "--json"}).out, done.out);
  EXPECT_EQ(run({"resume", "out", "--quiet"}).out, "");
  EXPECT_THAT(run({"resume", "out"}).out, HasSubstr("there is nothing to resume\n"));
}

TEST_F(CliTest, ALostCheckpointOfTheEndIsCalledSo) {
  write("small.yaml", kScene);
  EXPECT_EQ(run({"run", "small.yaml", "-o", "first"}).code, 0);
  fs::remove(folder_.path() / "first" / "checkpoint.clca");
  const auto result = run({"check", "small.yaml", "--begin", "first"});
  EXPECT_EQ(result.code, 2);
  EXPECT_THAT(result.err, HasSubstr("has lost the checkpoint of its end"));
}

TEST_F(CliTest, ASceneOfTheProgramIsFoundByItsName) {
  const auto result = run({"check", "wall-removal"});
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("Wall-removal flow test"));
  write("wall-removal", "clca: 1\nboks: 3\n");  // a file of the user comes first
  EXPECT_THAT(run({"check", "wall-removal"}).err, StartsWith("wall-removal:2:1: error: "));
  EXPECT_THAT(run({"check", "wall-remval"}).err,
              AllOf(StartsWith("wall-remval:1:1: error: cannot read the file: No such file"),
                    ::testing::EndsWith("; did you mean 'wall-removal'?\n")));
}

TEST_F(CliTest, ASceneMayComeFromStandardInput) {
  write("small.yaml", kScene);
  const auto result = testing::run_program(
      {"-c", "\"$0\" run - --json --frames-every 0 < small.yaml", CLCA_PROGRAM},
      {.folder = folder_.path().string(), .program = "/bin/sh"});
  EXPECT_EQ(result.code, 0) << result.err;
  run({"run", "small.yaml", "-o", "file"});
  EXPECT_EQ(summary("renders/stdin")["state_hash"], summary("file")["state_hash"]);
  EXPECT_EQ(nlohmann::json::parse(result.out), summary("renders/stdin"));
  EXPECT_THAT(run({"check", "-"}).err, StartsWith("stdin:1:1: error: "));
}

TEST_F(CliTest, WrongUsageIsExitCodeTwo) {
  for (const auto& arguments :
       std::vector<std::vector<std::string>>{{},
                                             {"fly"},
                                             {"run"},
                                             {"run", "a", "b"},
                                             {"run", "a.yaml", "--threads", "0"},
                                             {"run", "a.yaml", "--seed", "-1"},
                                             {"diff", "a.png"}}) {
    const auto result = run(arguments);
    EXPECT_EQ(result.code, 2);
    EXPECT_EQ(result.out, "");
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  }
}

TEST_F(CliTest, RunWritesIntoRendersByDefaultAndEndsWithTheHash) {
  write("small.yaml", kScene);
  const auto result = run({"run", "small.yaml"});
  EXPECT_EQ(result.code, 0) << result.err;
  const auto json = summary("renders/small");
  EXPECT_THAT(result.out, HasSubstr("state " + json["state_hash"].get<std::string>()));
  EXPECT_THAT(result.out, HasSubstr("particle-updates/s"));
}

TEST_F(CliTest, RunAgainIntoTheSameFolderReplacesTheRun) {
  write("small.yaml", kScene);
  EXPECT_EQ(run({"run", "small.yaml", "-o", "out"}).code, 0);
  EXPECT_EQ(run({"run", "small.yaml", "-o", "out", "--frames-every", "0"}).code, 0);
  EXPECT_FALSE(fs::exists(folder_.path() / "out" / "frames"));
}

TEST_F(CliTest, QuietPrintsNothing) {
  write("small.yaml", kScene);
  const auto result = run({"run", "small.yaml", "--quiet"});
  EXPECT_EQ(result.out + result.err, "");
}

TEST_F(CliTest, SeedAndSetChangeTheRunAndAreKeptInTheResolvedScene) {
  write("small.yaml", kScene);
  run({"run", "small.yaml", "-o", "a"});
  run({"run", "small.yaml", "-o", "b", "--seed", "6", "--set", "rules.inertia=0.5"});
  EXPECT_NE(summary("a")["state_hash"], summary("b")["state_hash"]);
  EXPECT_EQ(run({"run", "b/scene.yaml", "-o", "c"}).code, 0);
  EXPECT_EQ(summary("b")["state_hash"], summary("c")["state_hash"]);
}

TEST_F(CliTest, CheckPrintsASceneThatRunsToTheSameState) {
  write("small.yaml", kScene);
  const auto check = run({"check", "small.yaml"});
  EXPECT_EQ(check.code, 0);
  EXPECT_THAT(check.out, AllOf(HasSubstr("inertia: 0.9"), HasSubstr("MiB of memory")));
  EXPECT_FALSE(fs::exists(folder_.path() / "renders"));
  write("resolved.yaml", check.out);
  run({"run", "small.yaml", "-o", "a"});
  run({"run", "resolved.yaml", "-o", "b"});
  EXPECT_EQ(summary("a")["state_hash"], summary("b")["state_hash"]);
}

TEST_F(CliTest, AMistakeInASceneIsOneLineWithItsPlace) {
  std::string scene = kScene;
  scene.replace(scene.find("hexagon"), 7, "hexagno");
  write("small.yaml", scene);
  expect_refused(run({"run", "small.yaml"}), 2,
                 AllOf(StartsWith("small.yaml:5:19: error: "), HasSubstr("hexagon")));
  expect_refused(run({"check", "missing.yaml"}), 2, StartsWith("missing.yaml:1:1: error: "));
  write("good.yaml", kScene);
  expect_refused(run({"run", "good.yaml", "--set", "rules.inertia=2"}), 2,
                 StartsWith("--set rules.inertia=2: error: "));
}

TEST_F(CliTest, AFillThatDoesNotFitIsWrongInputWithItsPlace) {
  write("small.yaml", kScene);
  expect_refused(run({"run", "small.yaml", "--set", "stages.packing.fill.counts.small=299"}), 2,
                 AllOf(HasSubstr("small.yaml:10:"), HasSubstr("of 299 small fitted")));
}

TEST_F(CliTest, ASceneBeyondTheMemoryLimitIsRefusedBeforeAnythingIsAllocated) {
  write("small.yaml", kScene);
  expect_refused(run({"run", "small.yaml", "--memory-limit", "64KiB"}), 2,
                 AllOf(StartsWith("small.yaml:3:"), HasSubstr("limit of 0.0625 MiB"),
                       HasSubstr("--memory-limit")));
  expect_refused(
      run({"run", "small.yaml", "--set", "box.width=800000", "--set", "box.height=1000000"}), 2,
      HasSubstr("MiB of memory"));
}

TEST_F(CliTest, WallsThatMeetAreWrongInputForCheckAndRunOnceTheMemoryIsKnownToSuffice) {
  write("small.yaml", kScene);
  const std::vector<std::string> meeting = {
      "--set", "walls.plate={box: [28, 40, 32, 60], motion: {direction: down, distance: 9}}",
      "--set", "stages.packing.move=[plate]"};
  for (const std::string command : {"check", "run"}) {
    std::vector<std::string> arguments = {command, "small.yaml"};
    arguments.insert(arguments.end(), meeting.begin(), meeting.end());
    expect_refused(run(arguments), 2,
                   AllOf(StartsWith("--set walls.plate="), HasSubstr("standing wall 'gate'")));
    arguments.insert(arguments.end(), {"--memory-limit", "64KiB"});
    expect_refused(run(arguments), 2, HasSubstr("--memory-limit"));
  }
}

TEST_F(CliTest, AnUnknownDriverOrVectorWidthIsRefusedInsteadOfCrashing) {
  write("small.yaml", kScene);
  const auto polygons = [&](const char* variable, const char* value) {
    return run({"run", "small.yaml", "--set", "output.frames.drawing=polygons"},
               {.environment = {{variable, value}}});
  };
  expect_refused(polygons("GALLIUM_DRIVER", "zink"), 2,
                 AllOf(StartsWith("small.yaml:14:"), HasSubstr("zink"), HasSubstr("llvmpipe")));
  expect_refused(polygons("LP_NATIVE_VECTOR_WIDTH", "512"), 2, HasSubstr("512"));
  EXPECT_EQ(run({"run", "small.yaml"}, {.environment = {{"GALLIUM_DRIVER", "zink"}}}).code, 0);
}

TEST_F(CliTest, APictureBeyondTheDriverIsRefusedWithTheLimit) {
  write("small.yaml", kScene);
  expect_refused(run({"run", "small.yaml", "--set", "output.frames.width=60000"}), 2,
                 AllOf(StartsWith("small.yaml:14:"), HasSubstr("60000")));
}

TEST_F(CliTest, AFolderThatCannotBeMadeIsAFailedRun) {
  write("small.yaml", kScene);
  write("file", "x");
  expect_refused(run({"run", "small.yaml", "-o", "file/out"}), 1,
                 AllOf(HasSubstr("file/out"), HasSubstr("Not a directory")));
  expect_refused(run({"run", "small.yaml", "-o", "/proc/out"}), 1, HasSubstr("/proc/out"));
}

TEST_F(CliTest, AFullDiskEndsTheRunWithItsReasonAndNoHalfFile) {
  CLCA_SKIP_IF_THREAD_SANITIZED();
  write("small.yaml", kScene);
  // Room for run.json and scene.yaml, not for a picture.
  const auto result = run({"run", "small.yaml", "-o", "out", "--set", "output.frames.width=4000",
                           "--set", "output.series=none", "--set", "output.checkpoint=none"},
                          {.file_size_limit = 9000});
  EXPECT_EQ(result.code, 1);
  EXPECT_THAT(result.err, AllOf(HasSubstr("cannot write"), HasSubstr(".png")));
  EXPECT_TRUE(fs::is_empty(folder_.path() / "out" / "frames"));
  EXPECT_EQ(summary("out")["status"], "failed");
}

TEST_F(CliTest, InterruptedRunsEndCleanlyWithWhatWasDone) {
  write("gas.yaml", kEndless);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    const auto result = run({"run", "gas.yaml", "-o", "out", "--overwrite"},
                            {.signal = signal, .once = "out/series.csv", .once_has = "\n1000,"});
    EXPECT_EQ(result.code, 128 + signal) << result.err;
    EXPECT_THAT(result.out, StartsWith("interrupted: "));
    EXPECT_THAT(result.err, HasSubstr("\ncontinue with: clca resume out\n"));
    const auto json = summary("out");
    EXPECT_EQ(json["status"], "interrupted");
    EXPECT_EQ(json["stages"][0]["ended"], "interrupted");
    const fs::path series = folder_.path() / "out" / "series.csv";
    const auto steps = testing::csv_column(series, "step");
    EXPECT_EQ(steps.back(), json["steps"].get<double>());
    fs::remove(series);  // the next signal waits for that of its run
  }
}

TEST_F(CliTest, DiffTellsAlikeFromDifferentAndWritesWhere) {
  image::Image image(20, 10, {200, 100, 50});
  store::write_whole_file(folder_.path() / "a.png", image::encode_png(image, {}));
  image.at(3, 4) = {190, 100, 50};
  store::write_whole_file(folder_.path() / "b.png", image::encode_png(image, {}));
  store::write_whole_file(folder_.path() / "c.png", image::encode_png(image::Image(5, 5, {}), {}));
  write("d.png", "no picture");
  EXPECT_EQ(run({"diff", "a.png", "a.png"}).code, 0);
  const auto different = run({"diff", "a.png", "b.png", "-o", "where.png"});
  EXPECT_EQ(different.code, 1);
  EXPECT_EQ(different.out, "1 pixels differ by up to 10 in x 3 to 3, y 4 to 4\n");
  EXPECT_TRUE(fs::exists(folder_.path() / "where.png"));
  EXPECT_EQ(run({"diff", "a.png", "b.png", "--tolerance", "10"}).code, 0);
  EXPECT_EQ(run({"diff", "a.png", "b.png", "--pixels", "1"}).code, 0);
  EXPECT_EQ(run({"diff", "a.png", "c.png"}).code, 1);
  expect_refused(run({"diff", "a.png", "d.png"}), 2, HasSubstr("d.png"));
  expect_refused(run({"diff", "a.png", "none.png"}), 2, HasSubstr("none.png"));
}

}  // namespace
}  // namespace clca::cli_test
