// Gases, as a user of the program meets them.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "clca/store/file.hpp"
#include "clca/store/table.hpp"
#include "support/program.hpp"
#include "support/runs.hpp"

namespace clca::boltzmann_test {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::MatchesRegex;
using ::testing::StartsWith;

constexpr const char* kGas = R"(clca: 1
seed: 5
boltzmann:
  particles: 500
  restitution: 0.5
  friction: 0.3
  until: 2
  ensemble: 2
)";

constexpr const char* kPrinted = R"(clca: 1
boltzmann:
  particles: 200
  restitution: 1
  friction: 0
  scheme: ogawa-kato
  time_step: 0.1
  until: 15
)";

/// The first is cold soon and then makes one step from row to row.
constexpr const char* kEndless = R"(clca: 1
boltzmann:
  particles: 1000
  restitution: [0.9, 0.5]
  friction: 0
  until: 1000000
output:
  series: {every: 10}
  histograms: [0]
  checkpoint: {seconds: 0.01}
)";

constexpr const char* kAutomaton = R"(clca: 1
box: {width: 60, height: 60}
species:
  small: {shape: {hexagon: 1}}
stages:
  - name: packing
    fill: {region: [0, 0, 30, 60], counts: {small: 30}}
)";

class GasCommand : public ::testing::Test {
 protected:
  GasCommand() {
    store::write_whole_file(folder_.path() / "gas.yaml", kGas);
    store::write_whole_file(folder_.path() / "printed.yaml", kPrinted);
    store::write_whole_file(folder_.path() / "endless.yaml", kEndless);
    store::write_whole_file(folder_.path() / "automaton.yaml", kAutomaton);
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
  void expect_refused(const testing::ProgramResult& result,
                      const ::testing::Matcher<std::string>& message) const {
    EXPECT_EQ(result.code, 2);
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_THAT(result.err, message);
    EXPECT_EQ(result.out, "");
    EXPECT_FALSE(fs::exists(folder_.path() / "renders"));
  }

  testing::ScratchFolder folder_;
};

TEST_F(GasCommand, RunAndBoltzmannDoTheSameAndEndWithTotalsAndHash) {
  for (const std::string command : {"run", "boltzmann"}) {
    const auto result = run({command, "gas.yaml", "-o", command});
    EXPECT_EQ(result.code, 0) << result.err;
    EXPECT_THAT(result.out,
                AllOf(HasSubstr("done: 1000 particles, "), HasSubstr(" collisions/s"),
                      HasSubstr("state " + summary(command)["state_hash"].get<std::string>())));
  }
  EXPECT_EQ(summary("run")["state_hash"], summary("boltzmann")["state_hash"]);
}

TEST_F(GasCommand, WritesIntoRendersByDefaultAndQuietlyWhenAsked) {
  const auto result = run({"boltzmann", "gas.yaml", "--quiet"});
  EXPECT_EQ(result.code, 0);
  EXPECT_EQ(result.out + result.err, "");
  EXPECT_EQ(summary("renders/gas")["kind"], "boltzmann");
}

TEST_F(GasCommand, SeedAndSetChangeTheRunAndAreKeptInTheResolvedScene) {
  run({"boltzmann", "gas.yaml", "-o", "a"});
  run({"boltzmann", "gas.yaml", "-o", "b", "--seed", "6", "--set", "boltzmann.friction=0.1"});
  EXPECT_NE(summary("a")["state_hash"], summary("b")["state_hash"]);
  EXPECT_EQ(run({"boltzmann", "b/scene.yaml", "-o", "c"}).code, 0);
  EXPECT_EQ(summary("b")["state_hash"], summary("c")["state_hash"]);
}

TEST_F(GasCommand, BoltzmannRefusesAnAutomaton) {
  expect_refused(run({"boltzmann", "automaton.yaml"}),
                 AllOf(StartsWith("automaton.yaml:2:6: error: "), HasSubstr("clca run takes")));
}

TEST_F(GasCommand, AMistakeInAGasIsOneLineWithItsPlace) {
  expect_refused(run({"boltzmann", "gas.yaml", "--set", "boltzmann.restitution=2"}),
                 StartsWith("--set boltzmann.restitution=2: error: "));
  expect_refused(run({"boltzmann", "missing.yaml"}), StartsWith("missing.yaml:1:1: error: "));
}

TEST_F(GasCommand, LongStepsOfThePrintedSchemeAreWarnedOfWithPlaceAndHeat) {
  const auto result = run({"boltzmann", "printed.yaml", "--quiet"});
  EXPECT_EQ(result.code, 0);
  EXPECT_EQ(result.out, "");
  EXPECT_THAT(result.err,
              MatchesRegex("warning: printed.yaml:2:1: a time step of 0.1 is too long for the "
                           "scheme ogawa-kato, whose bias grows with it: elastic spheres heat by "
                           "46 % until time 15; 0.025 or less is what it was made for\n"));
}

TEST_F(GasCommand, CheckPrintsAGasThatRunsToTheSameState) {
  const auto check = run({"check", "gas.yaml"});
  EXPECT_EQ(check.code, 0);
  EXPECT_THAT(check.out, AllOf(HasSubstr("energy_ratio: 1"), HasSubstr("scheme: majorant"),
                               HasSubstr("# 1 x 2 runs of 500 particles, about "),
                               HasSubstr("MiB of memory on ")));
  EXPECT_FALSE(fs::exists(folder_.path() / "renders"));
  store::write_whole_file(folder_.path() / "resolved.yaml", check.out);
  run({"run", "gas.yaml", "-o", "a"});
  run({"run", "resolved.yaml", "-o", "b"});
  EXPECT_EQ(summary("a")["state_hash"], summary("b")["state_hash"]);
}

TEST_F(GasCommand, AGasBeyondTheMemoryLimitIsRefusedWithItsPlace) {
  for (const std::string command : {"run", "boltzmann"}) {
    expect_refused(
        run({command, "gas.yaml", "--memory-limit", "16KiB"}),
        AllOf(StartsWith("gas.yaml:3:"), HasSubstr("500 particles"), HasSubstr("--memory-limit")));
  }
}

TEST_F(GasCommand, InterruptedItEndsCleanlyWithWholeTables) {
  for (const int signal : {SIGINT, SIGTERM}) {
    const std::string out = "out" + std::to_string(signal);
    const auto result = run(
        {"boltzmann", "endless.yaml", "-o", out, "--threads", "1"},
        {.signal = signal, .once = out + "/checkpoint-previous.clca", .once_has = "checkpoint"});
    EXPECT_EQ(result.code, 128 + signal) << result.err;
    EXPECT_THAT(result.out, HasSubstr("interrupted: "));
    const auto json = summary(out);
    EXPECT_EQ(json["status"], "interrupted");
    const auto& last = json["stages"].back();
    EXPECT_EQ(last["ended"], "interrupted");
    const auto series = store::read_table(folder_.path() / out / "series.csv");
    EXPECT_EQ(series.column_numbers("time").back(), last["measures"]["time"].get<double>());
    EXPECT_EQ(store::read_table(folder_.path() / out / "histogram-0.csv").row_count() % 40, 0U);
  }
}

}  // namespace
}  // namespace clca::boltzmann_test
