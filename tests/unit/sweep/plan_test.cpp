#include "clca/sweep/plan.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

namespace clca::sweep::plan_test {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::MatchesRegex;
using ::testing::StartsWith;
using ::testing::ThrowsMessage;

Request request(const std::vector<std::string>& variations, const std::string& seeds = "1..2",
                std::vector<scene::Override> overrides = {}) {
  Request result = {.scene_file = std::string(CLCA_SOURCE_DIR) + "/scenes/wall-removal.yaml",
                    .overrides = std::move(overrides),
                    .variations = {},
                    .seeds = parse_seeds(seeds)};
  for (const std::string& text : variations) {
    result.variations.push_back(parse_variation(text));
  }
  return result;
}

TEST(Plan, IsTheGridOfAllValuesTheLastVariationFastestAndSeedsWithin) {
  const Plan grid = plan(request({"rules.inertia=0,0.9", "rules.scatter=0.1,0.2,0.3"}));
  ASSERT_EQ(grid.run_count(), 12U);
  EXPECT_THAT(grid.variants[0].values, ElementsAre("0", "0.1"));
  EXPECT_THAT(grid.variants[1].values, ElementsAre("0", "0.2"));
  EXPECT_THAT(grid.variants[3].values, ElementsAre("0.9", "0.1"));
  EXPECT_EQ(grid.run_name(0), "rules.inertia=0,rules.scatter=0.1,seed=1");
  EXPECT_EQ(grid.run_name(1), "rules.inertia=0,rules.scatter=0.1,seed=2");
  EXPECT_EQ(grid.run_name(11), "rules.inertia=0.9,rules.scatter=0.3,seed=2");
  const scene::Scene last = grid.scene(11);
  EXPECT_EQ(last.automaton_rules.inertia, 0.9);
  EXPECT_EQ(last.automaton_rules.scatter, 0.3);
  EXPECT_EQ(last.seed, 2U);
}

TEST(Plan, WithoutVariationsItHasOneRunASeed) {
  const Plan seeds = plan(request({}, "3,5..6", {"rules.inertia=0.5"}));
  ASSERT_EQ(seeds.run_count(), 3U);
  EXPECT_EQ(seeds.run_name(1), "seed=5");
  EXPECT_EQ(seeds.scene(1).seed, 5U);
  EXPECT_EQ(seeds.scene(1).automaton_rules.inertia, 0.5);
}

TEST(Plan, RefusesASceneOfTheBoltzmannEquation) {
  Request gas = request({"boltzmann.friction=0,0.3"});
  gas.scene_file = std::string(CLCA_SOURCE_DIR) + "/scenes/boltzmann-case1.yaml";
  EXPECT_THAT([&] { plan(gas); }, ThrowsMessage<scene::SceneError>(
                                      HasSubstr("error: a sweep takes scenes of grains only")));
}

TEST(Plan, NamesOfRunsFitAFileSystemAndStayApart) {
  std::string longer = "\"a";
  longer += std::string(150, 'x');
  const Plan odd = plan(request({"title=a/b,a b,\"a,b\",ä," + longer + "1\"," + longer + "2\""}));
  std::set<std::string> names;
  for (std::size_t run = 0; run < odd.run_count(); ++run) {
    EXPECT_THAT(odd.run_name(run), MatchesRegex("[A-Za-z0-9=,._+-]{1,160}"));
    names.insert(odd.run_name(run));
  }
  EXPECT_EQ(names.size(), odd.run_count());
  EXPECT_EQ(plan(request({"title=a/b"})).run_name(0), odd.run_name(0));
}

TEST(Plan, AWrongValueIsRefusedWithItsPlaceWhereverItStandsInTheGrid) {
  EXPECT_THAT([] { plan(request({"rules.inertia=0,0.5,2"})); },
              ThrowsMessage<scene::SceneError>(
                  StartsWith("--vary rules.inertia=2: error: rules.inertia: expected a number")));
  EXPECT_THAT([] { plan(request({"rules.inertai=0"})); },
              ThrowsMessage<scene::SceneError>(
                  AllOf(StartsWith("--vary rules.inertai=0: error: "), HasSubstr("did you mean"))));
  EXPECT_THAT([] { plan(request({}, "1", {"rules.inertia=2"})); },
              ThrowsMessage<scene::SceneError>(StartsWith("--set rules.inertia=2: error: ")));
  EXPECT_THAT([] { plan(request({"walls.right.box=[1,0,2"})); },
              ThrowsMessage<scene::SceneError>(StartsWith("--vary walls.right.box=[1,0,2: ")));
}

TEST(Plan, ARangeWithoutAStepIsToldWhatItLacks) {
  EXPECT_THAT([] { plan(request({"rules.inertia=0:1"})); },
              ThrowsMessage<scene::SceneError>(
                  ::testing::EndsWith("found '0:1'; a range is FIRST:LAST:STEP")));
  EXPECT_EQ(plan(request({"title=1:2"})).run_count(), 2U);
}

TEST(Plan, ARangeMayHaveAUnitOfLength) {
  const auto rows = [](const char* text) { return parse_variation(text).value_rows; };
  const std::vector<std::vector<std::string>> expected = {{"1.5 mm"}, {"2 mm"}, {"2.5 mm"}};
  EXPECT_EQ(rows("box.width=1.5 mm:2.5mm:.5  mm"), expected);
  EXPECT_EQ(rows("title=1 km:2 km:1 km").size(), 1U);
  EXPECT_THAT([&] { rows("box.width=1 cm:15 mm:1 mm"); },
              ThrowsMessage<scene::SceneError>(
                  ::testing::EndsWith("1 cm:15 mm:1 mm: expected FIRST:LAST:STEP in one unit")));
  EXPECT_THAT([&] { rows("box.width=10 mm:15 mm:1"); },
              ThrowsMessage<scene::SceneError>(::testing::EndsWith("in one unit")));
  EXPECT_THAT(
      [] { plan(request({"box.width=10 mm:15 mm"})); },
      ThrowsMessage<scene::SceneError>(::testing::EndsWith("; a range is FIRST:LAST:STEP")));
}

TEST(Plan, AKeyWithTheNameOfAColumnOfItsTablesIsRefused) {
  for (const char* key : {"steps", "status", "folder", "mean", "low", "stage", "measure"}) {
    EXPECT_THAT([&] { plan(request({std::string(key) + "=1,2"})); },
                ThrowsMessage<scene::SceneError>(
                    HasSubstr("tables of a sweep have a column '" + std::string(key) + "'")));
  }
}

TEST(Plan, AKeyIsSetInOnePlaceOnlyAndTheSeedNowhereElse) {
  EXPECT_THAT(
      [] { plan(request({"seed=1,2"})); },
      ThrowsMessage<scene::SceneError>(AllOf(StartsWith("--vary seed=1"), HasSubstr("--seeds"))));
  EXPECT_THAT(
      [] { plan(request({}, "1", {"seed=1"})); },
      ThrowsMessage<scene::SceneError>(AllOf(StartsWith("--set seed=1"), HasSubstr("--seeds"))));
  EXPECT_THAT(
      [] {
        plan(request({"rules.inertia=0", "rules.inertia=1"}));
      },
      ThrowsMessage<scene::SceneError>(
          "--vary rules.inertia=1: error: it would replace what --vary "
          "rules.inertia=0 sets"));
  EXPECT_THAT([] { plan(request({"rules.inertia=0"}, "1", {"rules.inertia=1"})); },
              ThrowsMessage<scene::SceneError>(HasSubstr("what --set rules.inertia=1 sets")));
  EXPECT_THAT(
      [] {
        plan(request({"stages.0.max_steps=5", "stages.packing.max_steps=6"}));
      },
      ThrowsMessage<scene::SceneError>(HasSubstr("what --vary stages.0.max_steps=5 sets")));
  EXPECT_THAT(
      [] {
        plan(request({"stages.0.until.steps=5", "stages.0.until.cycles=6"}));
      },
      ThrowsMessage<scene::SceneError>(HasSubstr("what --vary stages.0.until.steps=5 sets")));
  EXPECT_THAT(
      [] {
        plan(request({"rules.inertia=0,1", "rules={scatter: 1}"}));
      },
      ThrowsMessage<scene::SceneError>(
          HasSubstr("it would replace what --vary rules.inertia=0 sets")));
  EXPECT_NO_THROW(plan(request({"rules={scatter: 1}", "rules.inertia=0,1"})));
  EXPECT_THAT([] { plan(request({"rules={scatter: 1}"}, "1", {"rules.inertia=1"})); },
              ThrowsMessage<scene::SceneError>(AllOf(
                  StartsWith("--vary rules="), HasSubstr("what --set rules.inertia=1 sets"))));
  EXPECT_THAT([] { plan(request({"title=Run #1,Run #2"})); },
              ThrowsMessage<scene::SceneError>(HasSubstr("begins a comment")));
}

TEST(Plan, MoreRunsThanASweepMayHaveAreRefusedBeforeTheyAreMade) {
  EXPECT_THAT(
      [] {
        plan(request({"rules.inertia=0,1", "rules.scatter=0,1"}, "1..50000"));
      },
      ThrowsMessage<scene::SceneError>(HasSubstr("at most 100000")));
}

}  // namespace
}  // namespace clca::sweep::plan_test
