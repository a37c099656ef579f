#include "sweep/tables.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sweep/overview.hpp"

namespace clca::sweep::tables_test {
namespace {

Plan bare_plan(std::size_t variants, std::uint64_t seeds) {
  Plan plan;
  plan.request.variations = {{{"rules.inertia"}, {}}};
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
  EXPECT_EQ(
      measures_table(plan, results),
      "rules.inertia,stage,measure,mean,standard_deviation,standard_error,runs,min,max,low,high\n"
      "0,flow,steps,5,0,0,2,5,5,5,5\n"
      "0,flow,slope,40.5,,,1,40.5,40.5,,\n"
      "0,flow,clogged,0.5,0.7071067811865476,0.5,2,0,1,0.21132486540518713,0.7886751345948129\n");
}

TEST(Tables, HaveNoFormulas) {
  Plan plan = bare_plan(5, 1);
  const std::vector<std::string> values = {"=1+1", "-2+3", "@a", "-0.5", "+x"};
  for (std::size_t i = 0; i < values.size(); ++i) {
    plan.variants[i].values = {values[i]};
  }
  const std::string table = runs_table(plan, std::vector<Result>(5));
  for (const char* row : {"\n'=1+1,1,", "\n'-2+3,1,", "\n'@a,1,", "\n-0.5,1,", "\n'+x,1,"}) {
    EXPECT_THAT(table, ::testing::HasSubstr(row));
  }
  const std::string measures =
      measures_table(plan, std::vector<Result>(5, done({{"slope", 40.5}})));
  EXPECT_THAT(measures, ::testing::HasSubstr("\n'=1+1,flow,"));
}

TEST(Tables, HaveWhatLeftUntilAClogFromAllRunsAlsoThoseThatDidNotClog) {
  const Plan plan = bare_plan(1, 4);
  const std::string measures = measures_table(
      plan, {done({{"discharged", 30.0}, {"clogged", true}}),
             done({{"discharged", 500.0}, {"clogged", false}}),
             done({{"discharged", 10.0}, {"clogged", true}}),
             done({{"discharged", 60.0}, {"clogged", true}, {"clogged.left", true}})});
  EXPECT_THAT(measures, ::testing::HasSubstr("\n0,flow,discharged_until_clog,200,,"
                                             "115.47005383792516,3,,,84.52994616207484,"
                                             "315.4700538379251"));
  EXPECT_THAT(measures, ::testing::Not(::testing::HasSubstr("until_clog.left")));
  EXPECT_THAT(measures_table(bare_plan(1, 1), {done({{"discharged", 9.0}, {"clogged", false}})}),
              ::testing::Not(::testing::HasSubstr("until_clog")));
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
  const Selection one_seed = selection(bare_plan(100, 1));
  EXPECT_EQ(one_seed.columns, 8);
  EXPECT_EQ(one_seed.runs.size(), 64U);
}

}  // namespace
}  // namespace clca::sweep::tables_test
