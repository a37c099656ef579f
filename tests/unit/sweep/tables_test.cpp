#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "clca/store/file.hpp"
#include "support/runs.hpp"
#include "sweep/results.hpp"

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

RunResult done(std::vector<store::NamedMeasure> measures) {
  RunResult result;
  result.status = Status::done;
  result.summary.steps = 7;
  result.summary.state_hash = 0xabc;
  result.summary.stages = {{"flow", 5, "settled", std::move(measures)}};
  return result;
}

TEST(Tables, HaveARowForEachRunAndForEachMeasure) {
  const Plan plan = bare_plan(2, 2);
  std::vector<RunResult> results(4);
  results[0] = done({{"slope", 40.5}, {"clogged", true}});
  results[1] = done({{"slope", {}}, {"clogged", false}});
  results[2].status = Status::failed;
  results[2].error = "a.yaml:1:1: error: too much, by far";
  EXPECT_EQ(runs_table(plan, results).table.to_csv(),
            "rules.inertia,seed,status,steps,state_hash,flow.steps,flow.slope,flow.clogged,folder,"
            "error\n"
            "0,1,done,7,0000000000000abc,5,40.5,1,\"runs/rules.inertia=0,seed=1\",\n"
            "0,2,done,7,0000000000000abc,5,,0,\"runs/rules.inertia=0,seed=2\",\n"
            "1,1,failed,,,,,,\"runs/rules.inertia=1,seed=1\",\"a.yaml:1:1: error: too much, by "
            "far\"\n"
            "1,2,waiting,,,,,,\"runs/rules.inertia=1,seed=2\",\n");
  EXPECT_EQ(
      measures_table(plan, results).table.to_csv(),
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
  const std::string table = runs_table(plan, std::vector<RunResult>(5)).table.to_csv();
  for (const char* row : {"\n'=1+1,1,", "\n'-2+3,1,", "\n'@a,1,", "\n-0.5,1,", "\n'+x,1,"}) {
    EXPECT_THAT(table, ::testing::HasSubstr(row));
  }
  const std::string measures =
      measures_table(plan, std::vector<RunResult>(5, done({{"slope", 40.5}}))).table.to_csv();
  EXPECT_THAT(measures, ::testing::HasSubstr("\n'=1+1,flow,"));
}

TEST(Tables, HaveWhatLeftUntilAClogFromAllRunsAlsoThoseThatDidNotClog) {
  const Plan plan = bare_plan(1, 4);
  const std::string measures =
      measures_table(plan,
                     {done({{"discharged", 30.0}, {"clogged", true}}),
                      done({{"discharged", 500.0}, {"clogged", false}}),
                      done({{"discharged", 10.0}, {"clogged", true}}),
                      done({{"discharged", 60.0}, {"clogged", true}, {"clogged.left", true}})})
          .table.to_csv();
  EXPECT_THAT(measures, ::testing::HasSubstr("\n0,flow,discharged_until_clog,200,,"
                                             "115.47005383792516,3,,,84.52994616207484,"
                                             "315.4700538379251"));
  EXPECT_THAT(measures, ::testing::Not(::testing::HasSubstr("until_clog.left")));
  EXPECT_THAT(measures_table(bare_plan(1, 1), {done({{"discharged", 9.0}, {"clogged", false}})})
                  .table.to_csv(),
              ::testing::Not(::testing::HasSubstr("until_clog")));
}

/// Of a stage of so many steps and one of six.
RunResult with_steps(std::uint64_t packing) {
  RunResult result = done({});
  result.summary.steps = packing + 6;
  result.summary.stages = {{"packing", packing, "settled", {}}, {"flow", 6, "settled", {}}};
  return result;
}

class MeanTablesTest : public ::testing::Test {
 protected:
  MeanTablesTest() : plan_(bare_plan(1, 2)) {
    plan_.variants[0].scene.output.series = scene::SeriesOutput{2};
    results_ = {with_steps(3), with_steps(4)};
  }
  void write(std::size_t run, const std::string& file, const std::string& text) const {
    const auto folder = folder_.path() / std::to_string(run);
    std::filesystem::create_directories(folder);
    store::write_whole_file(folder / file, text);
  }
  /// NAME: CONTENT of each.
  std::vector<std::string> tables() {
    std::vector<std::string> texts;
    const auto folder_of = [&](std::size_t run) { return folder_.path() / std::to_string(run); };
    for (const NamedTable& table :
         mean_tables(plan_, results_, folder_of,
                     [&](const std::string& line) { warnings_.push_back(line); })) {
      texts.push_back(table.name + ".csv: " + table.table.to_csv());
    }
    return texts;
  }

  testing::ScratchFolder folder_;
  Plan plan_;
  std::vector<RunResult> results_;
  std::vector<std::string> warnings_;
};

TEST_F(MeanTablesTest, OfTimeBeginWithEachStageAndGoAsFarAsAllRunsDo) {
  // Rows at every second step of the run; those of one stage are at odd steps, so values between.
  write(0, "series.csv",
        "step,stage,h,some\n0,packing,0,1\n2,packing,2,\n4,flow,4,1\n6,flow,6,1\n8,flow,8,1\n");
  write(1, "series.csv",
        "step,stage,h,some\n0,packing,0,1\n2,packing,2,1\n4,packing,4,1\n6,flow,6,1\n8,flow,8,1\n"
        "10,flow,10,1\n");
  EXPECT_THAT(tables(), ::testing::ElementsAre(
                            "mean-series.csv: rules.inertia,stage,step,runs,h,h_se,some,some_se\n"
                            "0,packing,0,2,0,0,1,0\n0,packing,2,2,2,0,,\n"
                            "0,flow,2,2,5.5,0.5,1,0\n0,flow,4,2,7.5,0.5,1,0\n"));
  results_[1].summary.units = results_[0].summary.units = {
      .length_unit = "m", .time_unit = "s", .velocity_unit = "m/s", .time_step = 0.5};
  EXPECT_THAT(tables().front(), ::testing::HasSubstr("stage,step,time,runs,h"));
  EXPECT_THAT(tables().front(), ::testing::HasSubstr("\n0,flow,4,2,2,7.5,0.5,"));
}

TEST_F(MeanTablesTest, OfPlacesHaveThoseThatAllRunsHave) {
  write(0, "profile-flow.csv", "x,height_end\n0,1\n1,2\n2,4\n");
  write(1, "profile-flow.csv", "x,height_end\n0,3\n2,4\n");
  write(0, "lines-flow.csv", "line,position,x,y,flux,flux_se\na,0,1,1,1,9\nb,0,5,5,2,9\n");
  write(1, "lines-flow.csv", "line,position,x,y,flux,flux_se\na,0,1,1,3,9\nb,0,5,5,4,9\n");
  EXPECT_THAT(tables(),
              ::testing::ElementsAre(
                  "mean-profile-flow.csv: rules.inertia,x,runs,height_end,height_end_se\n"
                  "0,0,2,2,1\n0,2,2,4,0\n",
                  "mean-lines-flow.csv: rules.inertia,line,position,x,y,runs,flux,flux_se\n"
                  "0,a,0,1,1,2,2,1\n0,b,0,5,5,2,3,1\n"));
  EXPECT_THAT(warnings_, ::testing::IsEmpty());
}

TEST_F(MeanTablesTest, LeaveOutRunsThatFailedAndTablesThatCannotBeRead) {
  write(0, "series.csv", "step,stage,h\n0,packing,1\n");
  write(1, "series.csv", "step,stage,h\n0,packing,3");
  EXPECT_THAT(tables().front(), ::testing::EndsWith("\n0,packing,0,1,1,\n"));
  EXPECT_THAT(warnings_, ::testing::ElementsAre(::testing::HasSubstr("the file is cut off")));
  results_[0].status = Status::failed;
  EXPECT_THAT(tables(), ::testing::IsEmpty());
  write(1, "series.csv", "step,stage,h\n4,packing,1\n2,packing,1\n");
  EXPECT_THAT(tables(), ::testing::IsEmpty());
  EXPECT_THAT(warnings_.back(), ::testing::HasSubstr("line 3: not behind the one before"));
}

TEST(Overview, ShowsTheFirstSeedsOfEachCombinationUpToABound) {
  EXPECT_THAT(overview_runs(bare_plan(2, 3)).runs, ::testing::ElementsAre(0, 1, 2, 3, 4, 5));
  const OverviewRuns many = overview_runs(bare_plan(20, 16));
  EXPECT_EQ(many.columns, 8);
  EXPECT_EQ(many.runs.size(), 64U);
  EXPECT_EQ(many.runs[8], 16U);  // the first seed of the second combination
  const OverviewRuns seeds_only = overview_runs(bare_plan(1, 100));
  EXPECT_EQ(seeds_only.columns, 8);
  EXPECT_EQ(seeds_only.runs.size(), 64U);
  const OverviewRuns one_seed = overview_runs(bare_plan(100, 1));
  EXPECT_EQ(one_seed.columns, 8);
  EXPECT_EQ(one_seed.runs.size(), 64U);
}

}  // namespace
}  // namespace clca::sweep::tables_test
