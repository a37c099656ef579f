// clca compare, as a user meets it.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "clca/store/file.hpp"
#include "support/compared_runs.hpp"
#include "support/program.hpp"
#include "support/runs.hpp"

namespace clca::compare_test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

constexpr const char* kShaken = R"(clca: 1
seed: 5
box: {width: 40, height: 80}
species:
  grain: {shape: {hexagon: 1}}
rules: {scatter: 1}
walls:
  floor: {box: [0, 0, 40, 1], passive: rigid, motion: {shake: {amplitude: 6}}}
stages:
  - name: packing
    fill: {region: [0, 1, 40, 80], counts: {grain: 80}}
  - name: shaking
    move: [floor]
    until: {cycles: 5}
output:
  fields: {cell: 13, every: 20}
)";

class CompareCommand : public ::testing::Test {
 protected:
  CompareCommand() {
    store::write_whole(folder_.path() / "shaken.yaml", kShaken);
    EXPECT_EQ(run({"run", "shaken.yaml", "-o", "shaken", "--quiet"}).code, 0);
    testing::write_gas(folder_.path() / "gas", "5", 0.001, 0.02);
  }
  testing::ProgramResult run(const std::vector<std::string>& arguments) const {
    return testing::run_program(arguments, {.folder = folder_.path().string()});
  }
  std::vector<std::uint8_t> bytes(const std::string& file) const {
    return testing::bytes_of(folder_.path() / file);
  }

  testing::ScratchFolder folder_;
};

TEST_F(CompareCommand, LeavesTwoTablesAndALineForEachDistance) {
  const auto result = run({"compare", "shaken", "gas", "-o", "out"});
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("stage shaking beside time 5\n"));
  EXPECT_THAT(result.out, HasSubstr("automaton:boltzmann_rotational"));
  EXPECT_EQ(testing::csv_column(folder_.path() / "out/comparison.csv", "automaton").size(), 20U);
  const auto distances = testing::csv_column(folder_.path() / "out/distances.csv", "distance");
  EXPECT_EQ(distances.size(), 8U);
  EXPECT_EQ(run({"compare", "shaken", "gas"}).code, 0);
  EXPECT_TRUE(fs::exists(folder_.path() / "renders/comparison/comparison.csv"));
}

TEST_F(CompareCommand, ARunOnSeveralThreadsLeavesTheSameTable) {
  EXPECT_EQ(run({"run", "shaken.yaml", "-o", "three", "--threads", "3", "--quiet"}).code, 0);
  EXPECT_EQ(bytes("shaken/fluctuation-shaking.csv"), bytes("three/fluctuation-shaking.csv"));
}

TEST_F(CompareCommand, ARunAgainWithoutFieldsLeavesNoTableBehind) {
  EXPECT_EQ(run({"run", "shaken.yaml", "-o", "shaken", "--quiet", "--set", "output={}"}).code, 0);
  EXPECT_FALSE(fs::exists(folder_.path() / "shaken/fluctuation-shaking.csv"));
  EXPECT_EQ(run({"compare", "shaken", "gas"}).code, 2);
}

TEST_F(CompareCommand, ARunOfNoParticlesIsExitCodeTwo) {
  const fs::path file = folder_.path() / "gas/run.json";
  const auto all = testing::bytes_of(file);
  std::string text(all.begin(), all.end());
  const std::string key = "\"particles\": ";
  const std::size_t at = text.find(key) + key.size();
  text.replace(at, text.find(',', at) - at, "0");
  store::write_whole(file, {text.begin(), text.end()});
  const auto result = run({"compare", "shaken", "gas"});
  EXPECT_EQ(result.code, 2);
  EXPECT_THAT(result.err, HasSubstr("gas: there are no particles"));
}

TEST_F(CompareCommand, WrongInputIsExitCodeTwoWithOneLine) {
  for (const auto& arguments : std::vector<std::vector<std::string>>{
           {"compare", "shaken"},
           {"compare", "gas", "shaken"},
           {"compare", "shaken", "nowhere"},
           {"compare", "shaken", "gas", "--stage", "none"},
           {"compare", "shaken", "gas", "--time", "6"},
           {"compare", "shaken", "gas", "--restitution", "0.5"}}) {
    const auto result = run(arguments);
    EXPECT_EQ(result.code, 2);
    EXPECT_EQ(result.out, "");
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  }
  EXPECT_FALSE(fs::exists(folder_.path() / "renders/comparison"));
}

TEST_F(CompareCommand, AFolderThatCannotBeWrittenIsAFailure) {
  const auto result = run({"compare", "shaken", "gas", "-o", "shaken.yaml"});
  EXPECT_EQ(result.code, 1);
  EXPECT_THAT(result.err, HasSubstr("shaken.yaml"));
}

}  // namespace
}  // namespace clca::compare_test
