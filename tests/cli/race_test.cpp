// Commands that write to one folder at the same time.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <future>
#include <string>
#include <vector>

#include "support/program.hpp"
#include "support/runs.hpp"

namespace clca::race_test {
namespace {

namespace fs = std::filesystem;
using Arguments = std::vector<std::string>;

constexpr const char* kScene = R"(clca: 1
box: {width: 24, height: 30}
species: {grain: {shape: {hexagon: 1}}}
stages:
  - {name: fall, fill: {region: [0, 0, 24, 30], counts: {grain: 15}}, until: {steps: 16}}
measure: [packing]
output:
  frames: {every: 8, width: 64, height: 64, caption: false}
  series: {every: 4}
  trajectory: {every: 8}
)";

class Race : public ::testing::Test {
 protected:
  Race() { std::ofstream(folder_.path() / "scene.yaml") << kScene; }

  testing::ProgramResult run(const Arguments& arguments) const {
    return testing::run_program(arguments, {.folder = folder_.path().string()});
  }
  /// Runs the commands at once in a copy of the folder, then one after the other.
  void expect_no_loser(const std::string& folder, const std::vector<Arguments>& commands) const {
    const fs::path at = folder_.path() / "at";
    fs::remove_all(at);
    fs::copy(folder_.path() / folder, at, fs::copy_options::recursive);
    std::vector<std::future<testing::ProgramResult>> results;
    for (const Arguments& command : commands) {
      results.push_back(std::async(std::launch::async, [&] { return run(command); }));
    }
    for (std::size_t i = 0; i < commands.size(); ++i) {
      expect_done(commands[i], results[i].get(), "at once");
    }
    for (const Arguments& command : commands) {
      expect_done(command, run(command), "afterwards");
    }
  }
  /// Alone, with itself twice at once, and with each of the others.
  void expect_no_losers(const std::string& folder, const std::vector<Arguments>& commands) const {
    for (auto one = commands.begin(); one != commands.end(); ++one) {
      expect_no_loser(folder, {*one, *one, *one});
      for (auto other = one + 1; other != commands.end(); ++other) {
        expect_no_loser(folder, {*one, *other, *one});
      }
    }
  }

 private:
  static void expect_done(const Arguments& command, const testing::ProgramResult& result,
                          const char* when) {
    EXPECT_EQ(result.code, 0) << ::testing::PrintToString(command) << ' ' << when << ": "
                              << result.err;
  }

  testing::ScratchFolder folder_;
};

TEST_F(Race, OfCommandsThatWriteToARunFolderHasNoLoser) {
  ASSERT_EQ(run({"run", "scene.yaml", "-o", "run", "--quiet"}).code, 0);
  expect_no_losers("run", {{"export", "at", "--format", "xyz"},
                           {"export", "at", "--format", "gsd"},
                           {"export", "at", "--format", "vtp"},
                           {"render", "at"},
                           {"plot", "at", "--only", "motion"},
                           {"report", "at", "--max-frames", "1"}});
}

TEST_F(Race, OfCommandsThatWriteToTheFolderOfASweepHasNoLoser) {
  ASSERT_EQ(run({"sweep", "scene.yaml", "--vary", "rules.inertia=0,1", "--seeds", "1", "-o",
                 "sweep", "--quiet"})
                .code,
            0);
  expect_no_losers("sweep", {{"report", "at"}, {"plot", "at"}});
}

}  // namespace
}  // namespace clca::race_test
