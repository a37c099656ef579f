#include "sweep/tables.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "sweep/overview.hpp"
#include "sweep/statistics.hpp"

namespace clca::sweep {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

Plan bare_plan(std::size_t variants, std::uint64_t seeds) {
  Plan plan;
  plan.request.variations = {{"rules.inertia", {}}};
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    plan.request.seeds.push_back(seed);
  }
  for (std::size_t i = 0; i < variants; ++i) {
    plan.variants.push_back({{std::to_string(i)}, {}});
  }
  return plan;
}

Result done(std::vector<store::NamedMeasure> measures) {
  Result result;
  result.status = Status::done;
  result.summary.steps = 7;
  result.summary.state_hash = 0xabc;
  result.summary.stages = {{"flow", 5, "settled", std::move(measures)}};
  return result;
}

TEST(Statistics, AreThoseOfTheSample) {
  const Statistics found = statistics({2, 4, 4, 4, 5, 5, 7, 9});
  EXPECT_DOUBLE_EQ(found.mean, 5);
  EXPECT_DOUBLE_EQ(found.standard_deviation, std::sqrt(32.0 / 7));
  EXPECT_DOUBLE_EQ(found.standard_error, std::sqrt(32.0 / 7 / 8));
  EXPECT_EQ(found.count, 8U);
  EXPECT_EQ(found.least, 2);
  EXPECT_EQ(found.most, 9);
}

TEST(Statistics, OfCountsWithAWholeMeanAreExact) {
  EXPECT_EQ(statistics({143, 165, 154, 121, 187}).mean, 154);
}

TEST(Statistics, LeaveOutWhatIsNoNumber) {
  const Statistics found = statistics({1, kNone, 3, std::numeric_limits<double>::infinity()});
  EXPECT_EQ(found.count, 2U);
  EXPECT_EQ(found.mean, 2);
}

TEST(Statistics, OfOneOrNoValueHaveNoSpread) {
  EXPECT_EQ(statistics({4}).mean, 4);
  EXPECT_TRUE(std::isnan(statistics({4}).standard_deviation));
  EXPECT_TRUE(std::isnan(statistics({4}).standard_error));
  EXPECT_TRUE(std::isnan(statistics({}).mean));
  EXPECT_TRUE(std::isnan(statistics({}).least));
  EXPECT_EQ(statistics({}).count, 0U);
}

TEST(Statistics, OfEqualValuesHaveASpreadOfExactlyZero) {
  EXPECT_EQ(statistics(std::vector<double>(16, 0.1)).standard_deviation, 0);
  EXPECT_EQ(statistics(std::vector<double>(16, 0.1)).mean, 0.1);
}

TEST(Tables, HaveARowForEachRunAndForEachMeasure) {
  const Plan plan = bare_plan(2, 2);
  std::vector<Result> results(4);
  results[0] = done({{"slope", 40.5}, {"clogged", true}});
  results[1] = done({{"slope", {}}, {"clogged", false}});
  results[2].status = Status::failed;
  results[2].error = "a.yaml:1:1: error: too much, by far";
  EXPECT_EQ(runs_table(plan, results),
            "rules.inertia,seed,status,steps,state_hash,flow.steps,flow.slope,flow.clogged,folder,"
            "error\n"
            "0,1,done,7,0000000000000abc,5,40.5,1,\"runs/rules.inertia=0,seed=1\",\n"
            "0,2,done,7,0000000000000abc,5,,0,\"runs/rules.inertia=0,seed=2\",\n"
            "1,1,failed,,,,,,\"runs/rules.inertia=1,seed=1\",\"a.yaml:1:1: error: too much, by "
            "far\"\n"
            "1,2,waiting,,,,,,\"runs/rules.inertia=1,seed=2\",\n");
  EXPECT_EQ(measures_table(plan, results),
            "rules.inertia,stage,measure,mean,standard_deviation,standard_error,runs,min,max\n"
            "0,flow,steps,5,0,0,2,5,5\n"
            "0,flow,slope,40.5,,,1,40.5,40.5\n"
            "0,flow,clogged,0.5,0.7071067811865476,0.5,2,0,1\n");
}

TEST(Overview, ShowsTheFirstSeedsOfEachCombinationUpToABound) {
  EXPECT_THAT(selection(bare_plan(2, 3)).runs, ::testing::ElementsAre(0, 1, 2, 3, 4, 5));
  const Selection many = selection(bare_plan(20, 16));
  EXPECT_EQ(many.columns, 8);
  EXPECT_EQ(many.runs.size(), 64U);
  EXPECT_EQ(many.runs[8], 16U);  // the first seed of the second combination
  const Selection seeds_only = selection(bare_plan(1, 100));
  EXPECT_EQ(seeds_only.columns, 8);
  EXPECT_EQ(seeds_only.runs.size(), 64U);
}

}  // namespace
}  // namespace clca::sweep
