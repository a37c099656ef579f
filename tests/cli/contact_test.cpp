// Runs of the contact model as a user meets them.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "support/program.hpp"
#include "support/runs.hpp"

namespace clca::contact_test {
namespace {

namespace fs = std::filesystem;
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
    fill: {region: [0, 0, 30, 60], counts: {small: 60}}
    until: {steps: 300}
  - name: flow
    remove: [gate]
    until: {steps: 300}
output:
  series: {every: 10}
)";

class ContactCliTest : public ::testing::Test {
 protected:
  ContactCliTest() { std::ofstream(folder_.path() / "small.yaml") << kScene; }

  testing::ProgramResult run(const std::vector<std::string>& arguments,
                             testing::ProgramSetting setting = {}) const {
    setting.folder = folder_.path().string();
    return testing::run_program(arguments, setting);
  }
  static std::string state_line(const testing::ProgramResult& result) {
    const std::size_t begin = result.out.find("state ");
    return begin == std::string::npos
               ? "none"
               : result.out.substr(begin, result.out.find('\n', begin) - begin);
  }

  testing::ScratchFolder folder_;
};

TEST_F(ContactCliTest, BothEnginesEndInTheSameState) {
  const auto fast = run({"run", "small.yaml", "--set", "model=contact"});
  EXPECT_EQ(fast.code, 0) << fast.err;
  EXPECT_THAT(state_line(fast), StartsWith("state "));
  const auto reference = run({"run", "small.yaml", "--set", "model=contact", "--engine",
                              "reference", "--threads", "2", "-o", "reference"});
  EXPECT_EQ(reference.code, 0) << reference.err;
  EXPECT_EQ(state_line(reference), state_line(fast));
  EXPECT_NE(state_line(run({"run", "small.yaml", "-o", "automaton"})), state_line(fast));
}

TEST_F(ContactCliTest, BothEnginesOfTheAutomatonEndInTheSameState) {
  const auto fast = run({"run", "small.yaml"});
  const auto reference = run({"run", "small.yaml", "--engine", "reference", "-o", "reference"});
  EXPECT_EQ(reference.code, 0) << reference.err;
  EXPECT_EQ(state_line(reference), state_line(fast));
}

TEST_F(ContactCliTest, AnUnknownEngineIsWrongInput) {
  const auto result = run({"run", "small.yaml", "--engine", "slow"});
  EXPECT_EQ(result.code, 2);
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  EXPECT_THAT(result.err, HasSubstr("--engine"));
  EXPECT_EQ(result.out, "");
  EXPECT_FALSE(fs::exists(folder_.path() / "renders"));
}

TEST_F(ContactCliTest, TimesAreInSecondsWithUnitsAndSayTheirUnitWithoutThem) {
  const auto plain = run({"run", "small.yaml", "--set", "model=contact", "-o", "plain"});
  const auto real = run({"run", "small.yaml", "--set", "model=contact", "--set",
                         "units={spacing: 1 mm}", "-o", "real"});
  EXPECT_EQ(real.code, 0) << real.err;
  EXPECT_EQ(state_line(real), state_line(plain));
  const auto summary = [&](const char* folder) {
    return nlohmann::json::parse(std::ifstream(folder_.path() / folder / "run.json"));
  };
  EXPECT_EQ(summary("plain")["units"]["time"], "√(spacing/gravity)");
  EXPECT_EQ(summary("plain")["units"]["spacing"], 1);
  EXPECT_EQ(summary("real")["units"]["time"], "s");
  EXPECT_EQ(summary("real")["units"]["velocity"], "m/s");
  EXPECT_EQ(summary("real")["units"]["spacing"], 0.001);
  EXPECT_THAT(plain.out, HasSubstr(" √(spacing/gravity)) in "));
  EXPECT_THAT(real.out, HasSubstr(" s) in "));
  const double factor = std::sqrt(0.001 / 9.81);
  const auto times = [&](const char* folder) {
    return testing::csv_column(folder_.path() / folder / "series.csv", "time");
  };
  ASSERT_EQ(times("real").size(), times("plain").size());
  for (std::size_t row = 0; row < times("plain").size(); ++row) {
    EXPECT_DOUBLE_EQ(times("real")[row], factor * times("plain")[row]);
  }
  for (const char* folder : {"plain", "real"}) {
    const nlohmann::json json = summary(folder);
    const double time_step = json["units"]["time_step"];
    EXPECT_EQ(json["time"], 600 * time_step);
    EXPECT_EQ(json["stages"][1]["time"], 300 * time_step);
    EXPECT_EQ(times(folder).back(), 600 * time_step);
    EXPECT_EQ(json["stages"][1]["measures"]["outflow_sites_per_time"], 0);
  }
}

TEST_F(ContactCliTest, RunsSayTheirModel) {
  const auto kind = [&](const char* folder) -> std::string {
    return nlohmann::json::parse(std::ifstream(folder_.path() / folder / "run.json"))["kind"];
  };
  run({"run", "small.yaml", "-o", "automaton"});
  EXPECT_EQ(kind("automaton"), "automaton");
  run({"run", "small.yaml", "--set", "model=contact", "-o", "contact"});
  EXPECT_EQ(kind("contact"), "contact");
  EXPECT_EQ(run({"report", "contact"}).code, 0);
  std::ifstream page(folder_.path() / "contact" / "report.html");
  EXPECT_THAT(std::string(std::istreambuf_iterator<char>(page), {}),
              HasSubstr("Lattice contact dynamics"));
  const std::string help = run({"--help"}).out;
  EXPECT_THAT(help, HasSubstr("contact dynamics"));
}

constexpr const char* kPumped = R"(clca: 1
model: contact
seed: 5
box: {width: 40, height: 60}
species: {small: {shape: {hexagon: 1}}}
walls:
  floor: {box: [0, 0, 40, 3], motion: {shake: {amplitude: 4, period: 2}}}
stages:
  - name: packing
    fill: {region: [0, 4, 40, 60], counts: {small: 60}}
    until: {steps: 300}
  - {name: shaking, move: [floor], until: {cycles: 2}, max_steps: 20000}
output: {series: {every: 1}}
)";

TEST_F(ContactCliTest, WallsMoveAndCyclesHaveTimes) {
  std::ofstream(folder_.path() / "pumped.yaml") << kPumped;
  const auto fast = run({"run", "pumped.yaml", "-o", "fast"});
  EXPECT_EQ(fast.code, 0) << fast.err;
  const auto reference = run({"run", "pumped.yaml", "-o", "slow", "--engine", "reference"});
  EXPECT_EQ(state_line(reference), state_line(fast));
  const fs::path folder = folder_.path() / "fast";
  const auto travel = testing::csv_column(folder / "series.csv", "travel.floor");
  EXPECT_EQ(*std::max_element(travel.begin(), travel.end()), 4);
  EXPECT_EQ(travel.back(), 0);
  const auto summary = nlohmann::json::parse(std::ifstream(folder / "run.json"));
  EXPECT_EQ(summary["stages"][1]["ended"], "cycles");
  const auto steps = testing::csv_column(folder / "cycles.csv", "step");
  const auto times = testing::csv_column(folder / "cycles.csv", "time");
  ASSERT_EQ(times.size(), 3U);
  for (std::size_t row = 0; row < times.size(); ++row) {
    EXPECT_EQ(times[row], steps[row] * summary["units"]["time_step"].get<double>());
  }
}

TEST_F(ContactCliTest, AShakeWithAWrongPeriodIsWrongInput) {
  std::ofstream(folder_.path() / "pumped.yaml") << kPumped;
  for (const char* period : {"0", "-3", "1.5", "fast"}) {
    const auto result = run(
        {"run", "pumped.yaml", "--set", std::string("walls.floor.motion.shake.period=") + period});
    EXPECT_EQ(result.code, 2);
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_THAT(result.err, HasSubstr("walls.floor.motion.shake.period: expected a whole number "
                                      "from 1 to "));
    EXPECT_THAT(result.err, HasSubstr(std::string("found '") + period + "'"));
  }
}

// Steps that are long for a fall from so high.
TEST_F(ContactCliTest, EnergyThatGrowsIsWarnedOfAndInTheSummary) {
  std::ofstream(folder_.path() / "high.yaml") << R"(clca: 1
model: contact
seed: 1
box: {width: 40, height: 300}
species: {small: {shape: {hexagon: 1}}}
contact: {resolution: 1, fall_height: 4, rolling: none, friction: 0}
stages:
  - name: fall
    fill: {region: [0, 0, 40, 300], counts: {small: 600}}
    until: {steps: 600}
output: {}
)";
  const auto result = run({"run", "high.yaml", "-o", "high"});
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("kinetic and potential energy have grown from "));
  EXPECT_THAT(result.err, HasSubstr("; choose a smaller contact.resolution\n"));
  const auto summary = nlohmann::json::parse(std::ifstream(folder_.path() / "high/run.json"));
  EXPECT_GT(summary["stages"][0]["measures"]["energy_growth"].get<double>(), 0.005);
}

TEST_F(ContactCliTest, CheckSaysWhatAStepTakes) {
  const std::vector<std::string> check = {"check",         "small.yaml", "--set",
                                          "model=contact", "--set",      "contact.fall_height=80"};
  EXPECT_THAT(run(check).out, HasSubstr("\n# a step takes 0.03162 √(spacing/gravity)\n#"));
  auto with_units = check;
  with_units.insert(with_units.end(), {"--set", "units={spacing: 1 mm}"});
  EXPECT_THAT(run(with_units).out, HasSubstr("\n# a step takes 0.0003193 s\n#"));
}

TEST_F(ContactCliTest, TheAutomatonHasNoUnits) {
  const auto refused = run({"run", "small.yaml", "--set", "units={spacing: 1 mm}"});
  EXPECT_EQ(refused.code, 2);
  EXPECT_EQ(refused.err,
            "--set units={spacing: 1 mm}: error: units: only model contact has it; remove "
            "it, or say 'model: contact'\n");
  EXPECT_EQ(run({"run", "small.yaml", "-o", "automaton"}).code, 0);
  const fs::path folder = folder_.path() / "automaton";
  EXPECT_FALSE(nlohmann::json::parse(std::ifstream(folder / "run.json")).contains("units"));
  EXPECT_THROW(testing::csv_column(folder / "series.csv", "time"), std::out_of_range);
}

TEST_F(ContactCliTest, ASweepOverTheSpacingHasTheTimeOfEachStage) {
  const auto result = run({"sweep", "small.yaml", "--set", "model=contact", "--vary",
                           "units.spacing=1mm,4mm", "--seeds", "1", "-o", "sizes"});
  EXPECT_EQ(result.code, 0) << result.err;
  const auto times = testing::csv_column(folder_.path() / "sizes" / "runs.csv", "flow.time");
  ASSERT_EQ(times.size(), 2U);
  EXPECT_DOUBLE_EQ(times[1], 2 * times[0]);
}

TEST_F(ContactCliTest, ARunStoppedByASignalOrByTimeEndsAsOneThatWasNot) {
  const std::vector<std::string> longer = {"run",   "small.yaml",
                                           "--set", "model=contact",
                                           "--set", "stages.flow.until={steps: 200000}",
                                           "--set", "output.checkpoint={every: 10000}",
                                           "-o"};
  const auto with = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments = longer;
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  };
  const auto stopped =
      run(with({"a"}), {.signal = SIGTERM, .once = "a/series.csv", .once_has = "\n10000,"});
  EXPECT_EQ(stopped.code, 128 + SIGTERM) << stopped.err;
  const auto timed = run({"resume", "a", "--time-limit", "0.1", "--engine", "reference"});
  EXPECT_EQ(timed.code, 124) << timed.err;
  const auto resumed = run({"resume", "a"});
  EXPECT_EQ(resumed.code, 0) << resumed.err;
  EXPECT_EQ(state_line(resumed), state_line(run(with({"b"}))));
}

}  // namespace
}  // namespace clca::contact_test
