// clca by mpirun, as a user meets it.

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <random>

#include "clca/process/program.hpp"
#include "support/missing.hpp"
#include "support/program.hpp"
#include "support/runs.hpp"

namespace clca::mpi_test {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::MatchesRegex;
using ::testing::Not;
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
  frames: none
)";

constexpr const char* kGas = R"(clca: 1
seed: 5
boltzmann:
  particles: 2000
  ensemble: 7
  restitution: [0.5, 0.8]
  friction: 0.3
  until: 2
output:
  series: {every: 0.1}
  histograms: [0, 1]
  bins: q10
)";

/// mpirun may print lines of its own before those of the program or behind.
bool has_once(const std::string& text, const std::string& part) {
  const std::size_t at = text.find(part);
  return at != std::string::npos && text.find(part, at + 1) == std::string::npos;
}

/// Open MPI does not start programs of root unless it is told to. What it keeps to the end lies in
/// modules that are unloaded before, so that leaks cannot be told from it.
const std::map<std::string, std::string> kEnvironment = {{"OMPI_ALLOW_RUN_AS_ROOT", "1"},
                                                         {"OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1"},
                                                         {"ASAN_OPTIONS", "detect_leaks=0"}};

class MpiTest : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto mpirun = process::find_program("mpirun");
    if (!mpirun || !fs::exists(fs::path(CLCA_PROGRAM).parent_path() / "clca-mpi")) {
      CLCA_SKIP_AS_MISSING("mpirun or clca-mpi is missing");
    }
    mpirun_ = *mpirun;
    std::ofstream(folder_.path() / "small.yaml") << kScene;
    std::ofstream(folder_.path() / "gas.yaml") << kGas;
  }
  testing::ProgramResult clca(const std::vector<std::string>& arguments) const {
    return testing::run_program(arguments, {.folder = folder_.path().string()});
  }
  /// mpirun with `options`, then clca with `arguments`.
  testing::ProgramResult together(std::vector<std::string> options,
                                  const std::vector<std::string>& arguments) const {
    options.insert(options.begin(), "--oversubscribe");
    options.emplace_back(CLCA_PROGRAM);
    options.insert(options.end(), arguments.begin(), arguments.end());
    return testing::run_program(options, {.folder = folder_.path().string(),
                                          .environment = kEnvironment,
                                          .program = mpirun_.string()});
  }
  /// As together(), with a command of its own for each rank: a program and its arguments.
  testing::ProgramResult each(const std::vector<std::vector<std::string>>& commands) const {
    std::vector<std::string> all = {"--oversubscribe"};
    for (const auto& command : commands) {
      all.insert(all.end(), {":", "-n", "1"});
      all.insert(all.end(), command.begin(), command.end());
    }
    all.erase(all.begin() + 1);
    return testing::run_program(all, {.folder = folder_.path().string(),
                                      .environment = kEnvironment,
                                      .program = mpirun_.string()});
  }
  std::string text(const std::string& file) const {
    const auto bytes = testing::bytes_of(folder_.path() / file);
    return {bytes.begin(), bytes.end()};
  }
  void expect_same_tables(const std::string& one, const std::string& other,
                          const std::vector<std::string>& names) const {
    for (const std::string& name : names) {
      EXPECT_EQ(text(one + "/" + name), text(other + "/" + name)) << name;
    }
  }

  testing::ScratchFolder folder_;
  fs::path mpirun_;
};

TEST_F(MpiTest, ASweepOfSeveralRanksLeavesTheTablesOfOneProcess) {
  const std::vector<std::string> call = {"sweep",   "small.yaml", "--vary", "rules.inertia=0,0.9",
                                         "--seeds", "1..6",       "-o",     "one"};
  clca(call);
  auto by_ranks = call;
  by_ranks.back() = "ranks";
  const auto result = together({"-n", "3"}, by_ranks);
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_THAT(result.out, StartsWith("12 runs: 12 done, 0 failed, in "));
  EXPECT_THAT(result.err, MatchesRegex("3 ranks, with [0-9]+ to [0-9]+ runs each\n"));
  EXPECT_EQ(std::count(result.out.begin(), result.out.end(), '\n'), 2) << result.out;
  expect_same_tables("one", "ranks", {"runs.csv", "measures.csv", "sweep.json"});
  EXPECT_THAT(together({"-n", "2"}, by_ranks).out, StartsWith("12 runs: 12 done (12 from before)"));
}

TEST_F(MpiTest, ASignalToOneRankStopsAllWithItsExitCode) {
  const std::vector<std::string> call = {
      CLCA_PROGRAM, "boltzmann", "gas.yaml", "-o", "out", "--set", "boltzmann.until=100000",
      "--set",      "output={}"};
  const std::string stopped = fmt::format(
      "{} & until [ -e out/run.json ]; do sleep 0.1; done; sleep 1; kill -TERM $!; wait $!",
      fmt::join(call, " "));
  const auto result = each({call, {"/bin/sh", "-c", stopped}});
  EXPECT_EQ(result.code, 143) << result.err;
  EXPECT_THAT(text("out/run.json"), HasSubstr("\"status\": \"interrupted\""));
}

TEST_F(MpiTest, AMistakeIsToldOnce) {
  const auto result = together({"-n", "3"}, {"sweep", "small.yaml", "--seeds", "4..1"});
  EXPECT_EQ(result.code, 2);
  EXPECT_TRUE(has_once(result.err, "--seeds 4..1: error: ")) << result.err;
  EXPECT_EQ(together({"-n", "2"}, {"sweep", "missing.yaml"}).code, 2);
}

TEST_F(MpiTest, WhyARankCannotBeginIsToldOnceAndNothingIsWritten) {
  const auto sweep = [](const char* scene, const char* seeds) {
    return std::vector<std::string>{CLCA_PROGRAM, "sweep", scene, "--seeds", seeds, "-o", "out"};
  };
  const auto result = each({sweep("small.yaml", "1..6"), sweep("missing.yaml", "1..6")});
  EXPECT_EQ(result.code, 2);
  EXPECT_TRUE(has_once(result.err, "rank 1: missing.yaml:1:1: error: ")) << result.err;
  const auto other = each({sweep("small.yaml", "1..6"), sweep("small.yaml", "1..7")});
  EXPECT_EQ(other.code, 2);
  EXPECT_TRUE(has_once(other.err, "rank 1: error: it was started with another scene")) << other.err;
  EXPECT_FALSE(fs::exists(folder_.path() / "out/runs/seed=1"));
}

TEST_F(MpiTest, WhatCannotBeWrittenEndsAllRanksWithOneLine) {
  fs::create_directories(folder_.path() / "out/runs");
  std::ofstream(folder_.path() / "out/runs/seed=4") << "x";
  const auto result =
      together({"-n", "3"}, {"sweep", "small.yaml", "--seeds", "1..9", "-o", "out", "--quiet"});
  EXPECT_EQ(result.code, 1);
  EXPECT_TRUE(has_once(result.err, "clca: error: cannot write to out/runs/seed=4")) << result.err;
}

TEST_F(MpiTest, GasesOfSeveralRanksHaveTheBitsOfOneProcess) {
  clca({"boltzmann", "gas.yaml", "-o", "one", "--quiet"});
  const auto result = together({"-n", "3"}, {"boltzmann", "gas.yaml", "-o", "ranks"});
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_EQ(result.err.find("warning"), std::string::npos) << result.err;
  expect_same_tables("one", "ranks", {"series.csv", "histogram-0.csv", "histogram-1.csv"});
  const std::string json = text("one/run.json");
  const std::size_t hash = json.find("\"state_hash\"");
  EXPECT_THAT(text("ranks/run.json"), HasSubstr(json.substr(hash, json.find('\n', hash) - hash)));
  EXPECT_THAT(text("ranks/run.json"), HasSubstr("\"ranks\": 3,"));
}

TEST_F(MpiTest, ARunThatIsTheWorkOfOneProcessIsDoneOnceAndResumedOnce) {
  ASSERT_EQ(clca({"run", "small.yaml", "-o", "out", "--quiet"}).code, 0);
  const auto result = together({"-n", "2"}, {"resume", "out", "--until", "3000"});
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_THAT(text("out/run.json"), HasSubstr("\"done\""));
}

// In place of one rank mpirun starts a shell, which kills clca below it once runs are under way.
// CLCA_KILLS says how often.
TEST_F(MpiTest, IfARankIsKilledAllEndAndTheSameCommandGoesOn) {
  const char* kills = std::getenv("CLCA_KILLS");
  const int rounds = kills != nullptr ? std::atoi(kills) : 2;
  // So many that the other ranks cannot carry them all out before mpirun ends them.
  const std::vector<std::string> call = {"sweep", "small.yaml", "--seeds", "1..1000", "-o", "out"};
  auto alone = call;
  alone.back() = "one";
  clca(alone);
  std::mt19937 random(std::random_device{}());
  for (int round = 0; round < rounds; ++round) {
    fs::remove_all(folder_.path() / "out");
    const int seed = std::uniform_int_distribution(5, 40)(random);
    const std::string script = fmt::format(
        "\"$@\" & while ! [ -e out/runs/seed={} ]; do sleep 0.005; done; kill -9 $!; wait $!",
        seed);
    std::vector<std::vector<std::string>> commands(3);
    commands[round % 2 == 0 ? 1 : 0] = {"sh", "-c", script, "sh"};
    for (auto& command : commands) {
      command.emplace_back(CLCA_PROGRAM);
      command.insert(command.end(), call.begin(), call.end());
    }
    const auto result = each(commands);
    SCOPED_TRACE(::testing::Message() << "killed at run " << seed << ": " << result.err);
    EXPECT_NE(result.code, 0);
    EXPECT_THAT(clca({"sweep", "small.yaml", "--seeds", "1..1000", "-o", "out", "--collect"}).err,
                HasSubstr("of 1000 runs are missing"));
    EXPECT_EQ(together({"-n", "3"}, call).code, 0);
    expect_same_tables("one", "out", {"runs.csv", "measures.csv"});
  }
}

TEST_F(MpiTest, AGasOfWhichARankWasKilledGoesOnToTheSameTables) {
  const std::vector<std::string> call = {
      "boltzmann", "gas.yaml",           "--set", "boltzmann.particles=4000",
      "--set",     "boltzmann.until=20", "--set", "output.checkpoint.seconds=0.05"};
  auto alone = call;
  alone.insert(alone.end(), {"-o", "one", "--quiet"});
  clca(alone);
  const std::string script =
      "\"$@\" & while ! [ -e ranks/checkpoint-previous.clca ]; do sleep 0.01; done; "
      "kill -9 $!; wait $!";
  std::vector<std::vector<std::string>> commands = {{}, {"sh", "-c", script, "sh"}};
  for (auto& command : commands) {
    command.emplace_back(CLCA_PROGRAM);
    command.insert(command.end(), call.begin(), call.end());
    command.insert(command.end(), {"-o", "ranks"});
  }
  EXPECT_NE(each(commands).code, 0);
  EXPECT_THAT(text("ranks/run.json"), Not(HasSubstr("\"done\"")));
  const auto result = together({"-n", "3"}, {"resume", "ranks"});
  EXPECT_EQ(result.code, 0) << result.err;
  expect_same_tables("one", "ranks", {"series.csv", "histogram-0.csv", "histogram-1.csv"});
}

TEST_F(MpiTest, PartsStayOfTheProcessesThatAreToldThem) {
  const auto result = testing::run_program(
      {"--oversubscribe", "-n", "2", "sh", "-c",
       fmt::format("{} sweep small.yaml --seeds 1..6 -o parts --part $((OMPI_COMM_WORLD_RANK+1))/2",
                   CLCA_PROGRAM)},
      {.folder = folder_.path().string(),
       .environment = kEnvironment,
       .program = mpirun_.string()});
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_THAT(clca({"sweep", "small.yaml", "--seeds", "1..6", "-o", "parts", "--collect"}).out,
              StartsWith("6 runs: 6 done (6 from before)"));
}

TEST(WithoutMpi, AProgramThatIsStartedTogetherSaysWhatItWantsOnce) {
  const testing::ScratchFolder folder;
  std::ofstream(folder.path() / "small.yaml") << kScene;
  fs::copy_file(CLCA_PROGRAM, folder.path() / "clca");
  testing::ProgramSetting setting = {
      .folder = folder.path().string(),
      .environment = {{"OMPI_COMM_WORLD_SIZE", "4"}, {"OMPI_COMM_WORLD_RANK", "0"}},
      .program = (folder.path() / "clca").string()};
  const auto first = testing::run_program({"sweep", "small.yaml"}, setting);
  EXPECT_EQ(first.code, 2);
  EXPECT_THAT(first.err, AllOf(StartsWith("clca: error: 4 processes have been started together"),
                               HasSubstr("--part")));
  setting.environment["OMPI_COMM_WORLD_RANK"] = "1";
  const auto second = testing::run_program({"sweep", "small.yaml"}, setting);
  EXPECT_EQ(second.code, 2);
  EXPECT_EQ(second.err, "");
  EXPECT_FALSE(fs::exists(folder.path() / "renders"));
  EXPECT_EQ(testing::run_program({"check", "small.yaml"}, setting).code, 0);
}

}  // namespace
}  // namespace clca::mpi_test
