// clca sweep as a user meets it.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <fstream>

#include "support/program.hpp"
#include "support/runs.hpp"
#include "support/sanitizers.hpp"

namespace clca::sweep_test {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr const char* kScene = R"(clca: 1
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
)";

/// A particle gas that takes as long as one likes.
constexpr const char* kGas = R"(clca: 1
box: {width: 60, height: 60}
species:
  small: {shape: {hexagon: 1}}
rules: {candidates: all}
stages:
  - name: gas
    fill: {region: [0, 0, 60, 60], counts: {small: 100}}
    until: {steps: 1000000000000}
)";

class SweepCommandTest : public ::testing::Test {
 protected:
  void SetUp() override {
    write("small.yaml", kScene);
    write("gas.yaml", kGas);
  }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_.path() / name) << text;
  }
  testing::ProgramResult sweep(std::vector<std::string> arguments,
                               testing::ProgramSetting setting = {}) const {
    arguments.insert(arguments.begin(), "sweep");
    setting.folder = folder_.path().string();
    return testing::run_program(arguments, setting);
  }
  std::string text(const std::string& file) const {
    const auto bytes = testing::bytes_of(folder_.path() / file);
    return {bytes.begin(), bytes.end()};
  }
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

TEST_F(SweepCommandTest, WritesTablesAndAnOverviewIntoRendersByDefault) {
  const auto result = sweep({"small.yaml", "--vary", "rules.inertia=0,0.9", "--seeds", "1..3"});
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_THAT(result.out, AllOf(StartsWith("6 runs: 6 done, 0 failed, in "),
                                HasSubstr("\nrenders/small-sweep\n")));
  for (const char* file : {"sweep.json", "runs.csv", "measures.csv", "overview.png",
                           "runs/rules.inertia=0.9,seed=3/run.json"}) {
    EXPECT_TRUE(fs::exists(folder_.path() / "renders/small-sweep" / file)) << file;
  }
}

TEST_F(SweepCommandTest, ItsMeasuresCanBePlotted) {
  sweep({"small.yaml", "--vary", "rules.inertia=0,0.9", "--vary", "rules.scatter=0,1", "--seeds",
         "1..2", "--set", "output.frames=none", "-o", "out"});
  const auto result = testing::run_program({"plot", "out", "--only", "sweep-packing-height_mean"},
                                           {.folder = folder_.path().string()});
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_EQ(result.out, "out/plots/sweep-packing-height_mean.png\n");
  EXPECT_GT(fs::file_size(folder_.path() / "out/plots/sweep-packing-height_mean.png"), 1000U);
}

TEST_F(SweepCommandTest, TakesEightSeedsByDefault) {
  EXPECT_THAT(sweep({"small.yaml", "--set", "output.frames=none"}).out, StartsWith("8 runs: "));
  EXPECT_FALSE(fs::exists(folder_.path() / "renders/small-sweep/overview.png"));
}

TEST_F(SweepCommandTest, ASecondCallRunsNothingAndWritesTheSameTables) {
  const std::vector<std::string> call = {"small.yaml", "--seeds", "1..3", "-o", "out"};
  sweep(call);
  const std::string runs = text("out/runs.csv");
  const auto again = sweep(call);
  EXPECT_THAT(again.out, StartsWith("3 runs: 3 done (3 from before), 0 failed"));
  EXPECT_EQ(text("out/runs.csv"), runs);
  const auto other =
      sweep({"small.yaml", "--seeds", "1..3", "-o", "out", "--set", "rules.scatter=0.5"});
  EXPECT_THAT(other.out + other.err, HasSubstr("replaces 3 of the finished runs in the folder"));
}

TEST_F(SweepCommandTest, WrongCallsAreOneLineAndExitCodeTwo) {
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases = {
      {{"small.yaml", "--seeds", "4..1"}, "--seeds 4..1: error: "},
      {{"small.yaml", "--seeds", "1,1"}, "--seeds 1,1: error: "},
      {{"small.yaml", "--vary", "rules.inertia"}, "clca: error: --vary: expected KEY=V1,V2,..., "},
      {{"small.yaml", "--vary", "rules.inertia=0,2"}, "--vary rules.inertia=2: error: "},
      {{"small.yaml", "--vary", "seed=1,2"}, "--vary seed=1: error: "},
      {{"small.yaml", "--set", "rules.inertia=2"}, "--set rules.inertia=2: error: "},
      {{"missing.yaml"}, "missing.yaml:1:1: error: "},
      {{"small.yaml", "--jobs", "0"}, "clca: error: "},
      {{"small.yaml", "--part", "4/3"}, "clca: error: --part: expected K/N with K from 1 to N "},
      {{"small.yaml", "--seed", "3"}, "clca: error: "},
      {{"small.yaml", "--memory-limit", "64KiB"}, "small.yaml:2:"},
  };
  for (const auto& [arguments, beginning] : cases) {
    expect_refused(sweep(arguments), 2, StartsWith(beginning));
  }
  expect_refused(sweep({"small.yaml", "--set", "output.frames.drawing=polygons"},
                       {.environment = {{"GALLIUM_DRIVER", "zink"}}}),
                 2, AllOf(StartsWith("small.yaml:13:"), HasSubstr("zink")));
}

TEST_F(SweepCommandTest, ValuesMayHoldCommasInBrackets) {
  const auto result = sweep({"small.yaml", "--seeds", "1", "--quiet", "-o", "out", "--vary",
                             "walls.gate.box=[30,0,31,60],[40,0,41,60]"});
  EXPECT_EQ(result.code, 0);
  EXPECT_EQ(result.out + result.err, "");
  EXPECT_THAT(text("out/runs.csv"), AllOf(HasSubstr("\n\"[30,0,31,60]\",1,done,"),
                                          HasSubstr("\n\"[40,0,41,60]\",1,done,")));
}

TEST_F(SweepCommandTest, FewerRunsGoAtATimeWhereMoreDoNotFitIntoMemory) {
  const auto result =
      sweep({"small.yaml", "--seeds", "1..40", "--jobs", "40", "--memory-limit", "3MiB"});
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("runs at a time, as more do not fit into memory"));
}

TEST_F(SweepCommandTest, FailedRunsAreNamedAndCountedAndTheExitCodeIsOne) {
  const auto result = sweep({"small.yaml", "--seeds", "1..2", "--quiet", "-o", "out", "--vary",
                             "stages.packing.fill.counts.small=299,30"});
  EXPECT_EQ(result.code, 1);
  EXPECT_THAT(result.err, AllOf(HasSubstr("counts.small=299,seed=2 failed: small.yaml:9:"),
                                HasSubstr("clca: error: 2 of 4 runs failed\n")));
  EXPECT_THAT(text("out/runs.csv"), AllOf(HasSubstr("\n299,1,failed,"), HasSubstr("\n30,1,done,")));
}

TEST_F(SweepCommandTest, AFullDiskIsOneLineAndExitCodeOne) {
  CLCA_SKIP_IF_THREAD_SANITIZED();
  // Room for run.json and scene.yaml, not for a picture.
  expect_refused(sweep({"small.yaml", "-o", "out", "--set", "output.frames.width=4000"},
                       {.file_size_limit = 9000}),
                 1, AllOf(StartsWith("clca: error: cannot write"), HasSubstr(".png")));
  expect_refused(sweep({"small.yaml", "-o", "/proc/out"}), 1, HasSubstr("/proc/out"));
}

TEST_F(SweepCommandTest, AfterCtrlCTheSameCallGoesOn) {
  const std::vector<std::string> call = {
      "gas.yaml", "-o",     "out",
      "--seeds",  "1..2",   "--jobs",
      "1",        "--vary", "stages.gas.until.steps=10,100000000"};
  const std::string long_one = "out/runs/stages.gas.until.steps=100000000,seed=1/run.json";
  for (const int signal : {SIGINT, SIGTERM}) {
    const auto result = sweep(call, {.signal = signal, .once = long_one});
    EXPECT_EQ(result.code, 128 + signal) << result.err;
    EXPECT_THAT(result.out, HasSubstr("2 interrupted or not begun"));
    EXPECT_THAT(text("out/runs.csv"), AllOf(HasSubstr("\n10,1,done,"), HasSubstr("\n10,2,done,"),
                                            HasSubstr("\n100000000,1,interrupted,"),
                                            HasSubstr("\n100000000,2,waiting,")));
    EXPECT_THAT(text(long_one), HasSubstr("\"interrupted\""));
    EXPECT_THAT(result.out, HasSubstr(signal == SIGINT ? "2 done, 0" : "2 done (2 from before)"));
  }
}

TEST_F(SweepCommandTest, AnInterruptedSweepComesToItsEndWhenCalledAgain) {
  const std::vector<std::string> call = {
      "gas.yaml", "-o", "out", "--seeds", "1..3", "--set", "stages.gas.until.steps=30000"};
  EXPECT_EQ(sweep(call, {.signal = SIGINT, .once = "out/runs/seed=1/run.json"}).code, 130);
  EXPECT_EQ(sweep(call).code, 0);
  auto other = call;
  other[2] = "whole";
  EXPECT_EQ(sweep(other).code, 0);
  EXPECT_EQ(text("out/runs.csv"), text("whole/runs.csv"));
  EXPECT_EQ(text("out/measures.csv"), text("whole/measures.csv"));
}

}  // namespace
}  // namespace clca::sweep_test
