// The program killed at random moments, and gone on with until it is done: time and again the same
// as a run that nobody has disturbed. CLCA_KILLS says how many runs; a few where it is not set.

#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <random>

#include "support/program.hpp"
#include "support/run_folders.hpp"
#include "support/runs.hpp"
#include "support/sanitizers.hpp"

namespace clca::kill_test {
namespace {

namespace fs = std::filesystem;

int rounds() {
  constexpr int kFew = 4;
  const char* text = std::getenv("CLCA_KILLS");
  return text != nullptr ? std::atoi(text) : kFew;
}

constexpr const char* kScene = R"(clca: 1
title: Everything that a run has to remember
seed: 11
box: {width: 60, height: 90}
species:
  small: {shape: {hexagon: 1}}
  large: {shape: {hexagon: 2}}
walls:
  plate: {box: [20, 70, 40, 72], motion: {direction: down, period: 2, distance: 50}, passive: overlap}
  floor: {box: [0, 0, 60, 2], motion: {direction: up, shake: {amplitude: 3, wait: 4}}, passive: rigid}
sources:
  spout: {at: [30, 85], species: {small: 1}, rate: 0.2, count: 60}
outlets:
  drain: {region: [50, 2, 60, 12]}
stages:
  - name: packing
    fill: {region: [0, 2, 50, 60], counts: {small: 120, large: 20}}
    until: {steps: 80}
  - name: shaking
    move: [floor]
    sources: [spout]
    until: {cycles: 12}
  - name: pressing
    move: [plate]
    until: {steps: 120}
output:
  frames: {every: 20, width: 192, height: 256, color_by: displacement}
  series: {every: 1}
  fields: {every: 30}
  contacts: {every: 2}
  trajectory: {every: 10}
  checkpoint: {every: 9}
)";

class Killed : public ::testing::Test {
 protected:
  Killed() { std::ofstream(folder_.path() / "all.yaml") << kScene; }

  /// Runs the program until it is done by itself; returns how often it was killed.
  int run_with_kills(const std::string& out, double longest) {
    std::uniform_real_distribution<double> moment(0.001, longest);
    std::vector<std::string> arguments = {"run", (folder_.path() / "all.yaml").string(), "-o", out,
                                          "--quiet"};
    int kills = 0;
    while (true) {
      const bool last = kills == 30;
      const auto result = testing::run_program(
          arguments, {.signal = SIGKILL, .signal_after = last ? 0 : moment(random_)});
      if (result.code != -SIGKILL) {
        EXPECT_EQ(result.code, 0) << result.err;
        return kills;
      }
      ++kills;
      if (fs::exists(fs::path(out) / "run.json")) {
        arguments = {"resume", out, "--quiet"};
      }
    }
  }

  testing::ScratchFolder folder_;
  std::mt19937 random_{seed()};

 private:
  /// CLCA_KILL_SEED, or one drawn now. Printed, so that a run that failed can be repeated.
  static unsigned seed() {
    const char* given = std::getenv("CLCA_KILL_SEED");
    const unsigned seed =
        given != nullptr ? static_cast<unsigned>(std::stoul(given)) : std::random_device()();
    std::cout << "CLCA_KILL_SEED=" << seed << '\n';
    return seed;
  }
};

// A machine may be faster at one moment than at another: where a run was over before it could be
// killed, kills come twice as early from then on.
TEST_F(Killed, AtRandomMomentsARunEndsAsIfNobodyHadDisturbedIt) {
  const std::string unbroken = (folder_.path() / "unbroken").string();
  const auto start = std::chrono::steady_clock::now();
  ASSERT_EQ(testing::run_program(
                {"run", (folder_.path() / "all.yaml").string(), "-o", unbroken, "--quiet"})
                .code,
            0);
  double longest = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  int killed = 0;
  for (int round = 0; killed < rounds() && round < 2 * rounds() + 10; ++round) {
    const std::string broken = (folder_.path() / ("broken-" + std::to_string(round))).string();
    const int kills = run_with_kills(broken, longest);
    ASSERT_EQ(testing::difference_of_runs(unbroken, broken), "") << "run " << round;
    if (kills > 0) {
      ++killed;
    } else {
      longest /= 2;
    }
  }
  EXPECT_EQ(killed, rounds()) << "runs that were killed on their way";
}

// A table that grows meets the end of the disk first; the checkpoints before it are whole.
TEST(FullDisk, EndsARunWithACheckpointThatCanBeGoneOnWith) {
  CLCA_SKIP_IF_THREAD_SANITIZED();
  const testing::ScratchFolder folder;
  const std::string scene = (folder.path() / "long.yaml").string();
  std::ofstream(scene) << R"(clca: 1
box: {width: 30, height: 40}
species: {grain: {shape: {hexagon: 1}}}
stages: [{name: fall, fill: {region: [0, 0, 30, 40], counts: {grain: 30}}, until: {steps: 4000}}]
output: {series: {every: 1}, checkpoint: {every: 300}}
)";
  const std::string unbroken = (folder.path() / "unbroken").string();
  const std::string broken = (folder.path() / "broken").string();
  ASSERT_EQ(testing::run_program({"run", scene, "-o", unbroken, "--quiet"}).code, 0);
  constexpr std::size_t kLimit = 100'000;
  ASSERT_GT(fs::file_size(unbroken + "/series.csv"), kLimit);
  ASSERT_LT(fs::file_size(unbroken + "/checkpoint.clca"), kLimit);
  const auto result =
      testing::run_program({"run", scene, "-o", broken, "--quiet"}, {.file_size_limit = kLimit});
  EXPECT_EQ(result.code, 1);
  EXPECT_EQ(result.err, "clca: error: cannot write " + broken + "/series.csv: File too large\n");
  EXPECT_EQ(testing::run_program({"resume", broken, "--quiet"}).code, 0);
  EXPECT_EQ(testing::difference_of_runs(unbroken, broken), "");
}

}  // namespace
}  // namespace clca::kill_test
