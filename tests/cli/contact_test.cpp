// Runs of the contact model as a user meets them.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "support/program.hpp"
#include "support/runs.hpp"

namespace clca {
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

TEST_F(ContactCliTest, AReferenceOfTheAutomatonOrAnUnknownEngineIsWrongInput) {
  for (const char* engine : {"reference", "slow"}) {
    const auto result = run({"run", "small.yaml", "--engine", engine});
    EXPECT_EQ(result.code, 2);
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_THAT(result.err, HasSubstr("--engine"));
    EXPECT_EQ(result.out, "");
    EXPECT_FALSE(fs::exists(folder_.path() / "renders"));
  }
}

TEST_F(ContactCliTest, ARunStoppedByASignalOrByTimeEndsAsOneThatWasNot) {
  const std::vector<std::string> longer = {
      "run", "small.yaml", "--set", "model=contact", "--set", "stages.flow.until={steps: 200000}",
      "-o"};
  const auto with = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments = longer;
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  };
  const auto stopped =
      run(with({"a"}), {.signal_after = 0.1, .once = "a/run.json", .signal = SIGTERM});
  EXPECT_EQ(stopped.code, 128 + SIGTERM) << stopped.err;
  const auto timed = run({"resume", "a", "--time-limit", "0.1", "--engine", "reference"});
  EXPECT_EQ(timed.code, 124) << timed.err;
  const auto resumed = run({"resume", "a"});
  EXPECT_EQ(resumed.code, 0) << resumed.err;
  EXPECT_EQ(state_line(resumed), state_line(run(with({"b"}))));
}

}  // namespace
}  // namespace clca
