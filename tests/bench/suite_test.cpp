// The suite of benchmarks, for a moment each: what its tables hold, never how long it took.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "clca/store/table.hpp"
#include "support/program.hpp"
#include "support/runs.hpp"

namespace clca::suite_test {
namespace {

using ::testing::AllOf;
using ::testing::Each;
using ::testing::Gt;
using ::testing::HasSubstr;
using ::testing::Le;
using ::testing::SizeIs;

class SuiteTest : public ::testing::Test {
 protected:
  testing::ProgramResult suite(std::vector<std::string> arguments) const {
    arguments.insert(arguments.end(), {"--seconds", "0.001", "--memory", "1", "-o", "out"});
    return testing::run_program(arguments,
                                {.folder = folder_.path().string(), .program = CLCA_SUITE});
  }
  store::ParsedTable table(const std::string& name) const {
    return store::read_table(folder_.path() / "out" / (name + ".csv"));
  }

  testing::ScratchFolder folder_;
};

TEST_F(SuiteTest, EveryCaseIsMeasuredForAllThreadsAndTiesAndWithoutSleeping) {
  const auto result = suite({"--sizes", "540", "--threads", "2"});
  ASSERT_EQ(result.code, 0) << result.err;
  const store::ParsedTable rows = table("automaton");
  ASSERT_THAT(*rows.find_column("case"), SizeIs(4 * 2 * 3));
  EXPECT_THAT(rows.column_numbers("step_s_best"), Each(Gt(0)));
  EXPECT_THAT(rows.column_numbers("effective_per_s"), Each(Gt(0)));
  std::map<std::string, double> share;
  std::map<std::string, double> at_rest;
  for (std::size_t row = 0; row < rows.row_count(); ++row) {
    share[(*rows.find_column("case"))[row]] = rows.column_numbers("moving_share")[row];
    at_rest[(*rows.find_column("case"))[row]] = rows.column_numbers("at_rest")[row];
  }
  EXPECT_EQ(share["falling"], 1);
  EXPECT_THAT(share["settling"], AllOf(Gt(share["collapse"]), Le(1)));
  EXPECT_GT(share["collapse"], 0);
  EXPECT_EQ(share["idle"], 0);
  EXPECT_THAT(at_rest, ::testing::UnorderedElementsAre(
                           ::testing::Pair("falling", 0), ::testing::Pair("settling", 1),
                           ::testing::Pair("collapse", 1), ::testing::Pair("idle", 1)));
}

TEST_F(SuiteTest, TheStepsOfAllSharesTogetherMoveAsManyAsTheRun) {
  ASSERT_EQ(suite({"--sizes", "300", "--threads", "1", "--cases", "settling,collapse"}).code, 0);
  using Key = std::tuple<std::string, std::string, std::string>;
  const auto moved = [&](const char* name) {
    const store::ParsedTable rows = table(name);
    std::map<Key, double> sums;
    for (std::size_t row = 0; row < rows.row_count(); ++row) {
      sums[{(*rows.find_column("case"))[row], (*rows.find_column("ties"))[row],
            (*rows.find_column("sleeping"))[row]}] += rows.column_numbers("moved")[row];
    }
    return sums;
  };
  EXPECT_THAT(moved("automaton"), SizeIs(8));
  EXPECT_EQ(moved("shares"), moved("automaton"));
}

TEST_F(SuiteTest, AFallingStepTouchesNoLessThanItsParticles) {
  ASSERT_EQ(suite({"--sizes", "2000", "--threads", "1", "--cases", "falling"}).code, 0);
  const store::ParsedTable rows = table("limits");
  ASSERT_THAT(*rows.find_column("case"), SizeIs(4));
  for (const double bytes : rows.column_numbers("run_bytes")) {
    EXPECT_GT(bytes, 2 * 12 * 2000.0 * 32);  // read and written, 12 bytes each, 32 steps
    EXPECT_LT(bytes, 2 * 64 * (1 + 2 * 2 * 19) * 2000.0 * 32);  // no line shared at all
  }
}

TEST_F(SuiteTest, LimitsOfTheMachineAreMeasuredUpToTheWorkingSetThatIsAskedFor) {
  ASSERT_EQ(suite({"--sizes", "100", "--threads", "2", "--cases", "idle"}).code, 0);
  const store::ParsedTable rows = table("machine");
  EXPECT_THAT(*rows.find_column("quantity"), SizeIs(4 + 4 + 4));  // 16, 64, 256, 1024 KiB
  EXPECT_THAT(rows.column_numbers("working_set_bytes"), Each(Le(1 << 20)));
  EXPECT_THAT(rows.column_numbers("value"), Each(Gt(0)));
}

TEST_F(SuiteTest, WhatItDoesNotKnowIsRefused) {
  EXPECT_NE(suite({"--cases", "moon"}).code, 0);
  EXPECT_THAT(suite({"--sizes", "0"}).err, HasSubstr("--sizes"));
}

}  // namespace
}  // namespace clca::suite_test
