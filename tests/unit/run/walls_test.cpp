// Runs with walls that move: how their stages end and what they leave.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "clca/run/run.hpp"
#include "support/runs.hpp"

namespace clca::run::walls_test {
namespace {

namespace fs = std::filesystem;
using ::testing::Contains;
using ::testing::HasSubstr;

constexpr const char* kPlate = R"(clca: 1
seed: 2
box: {width: 30, height: 80}
species:
  small: {shape: {hexagon: 1}}
  large: {shape: {hexagon: 2}}
walls:
  plate: {box: [12, 50, 18, 80], passive: overlap, motion: {direction: down, period: 2, distance: 60}}
stages:
  - name: packing
    fill: {region: [0, 0, 30, 80], counts: {small: 30, large: 30}}
  - name: push
    insert: [plate]
    move: [plate]
output:
  series: {every: 1}
  contacts: {every: 2}
)";

constexpr const char* kShaken = R"(clca: 1
seed: 3
box: {width: 20, height: 60}
rules: {scatter: 1}
species:
  grain: {shape: {hexagon: 1}}
  nut: {shape: {hexagon: 3}}
walls:
  floor: {box: [0, 0, 20, 1], motion: {shake: {amplitude: 3}}}
stages:
  - name: packing
    fill: {region: [0, 1, 20, 60], counts: {grain: 40, nut: 1}}
  - name: shaking
    move: [floor]
    until: {cycles: 5}
output:
  fields: {cell: 5, every: 20}
)";

scene::Scene plate(const std::vector<scene::Override>& overrides = {}) {
  return scene::parse(kPlate, "plate.yaml", overrides);
}

std::string first_line(const fs::path& file) {
  std::ifstream stream(file);
  std::string line;
  std::getline(stream, line);
  return line;
}

TEST(WallsInRuns, APlateThatStallsEndsItsStageAndTheLogSaysSinceWhenAndHowDeep) {
  const testing::ScratchFolder folder;
  std::vector<std::string> lines;
  const auto summary = run(plate(), {.folder = folder.path()},
                           {.message = [&](const std::string& text) { lines.push_back(text); }});
  ASSERT_EQ(summary.stages[1].end_reason, "stalled");
  const double since = testing::measure_of(summary, "push", "stalled_since");
  EXPECT_GT(since, static_cast<double>(summary.stages[0].steps));
  EXPECT_LT(since, static_cast<double>(summary.steps));
  EXPECT_EQ(testing::measure_of(summary, "push", "overlap_depth_max"), 1);
  EXPECT_THAT(lines, Contains(::testing::AllOf(HasSubstr("wall plate stalls since step"),
                                               HasSubstr("spacings deep"), HasSubstr("jammed"))));
  EXPECT_EQ(testing::csv_column(folder.path() / "series.csv", "moving").back(), 0);
}

TEST(WallsInRuns, TablesOfContactsAgreeWithTheSummary) {
  const testing::ScratchFolder folder;
  const auto summary = run(plate(), {.folder = folder.path()});
  const fs::path contacts = folder.path() / "contacts-push.csv";
  EXPECT_EQ(first_line(contacts), "first,second,x,y,sites,depth,source,mean_sites,share");
  double sites = 0;
  double pairs = 0;
  for (const double one : testing::csv_column(contacts, "sites")) {
    sites += one;
    pairs += one > 0 ? 1 : 0;
  }
  EXPECT_GT(pairs, 0);
  EXPECT_EQ(sites, testing::measure_of(summary, "push", "overlap_sites"));
  EXPECT_EQ(pairs, testing::measure_of(summary, "push", "overlap_contacts"));
  for (const double share : testing::csv_column(contacts, "share")) {
    EXPECT_GT(share, 0);
    EXPECT_LE(share, 1);
  }
  double loads = 0;
  for (const double one : testing::csv_column(folder.path() / "loads-push.csv", "sites")) {
    loads += one;
  }
  EXPECT_GT(loads, sites);  // a contact of two particles loads both
  EXPECT_LE(loads, 2 * sites);
  const fs::path walls = folder.path() / "walls-push.csv";
  EXPECT_EQ(testing::csv_column(walls, "stalled_since").front(),
            testing::measure_of(summary, "push", "stalled_since"));
  EXPECT_EQ(testing::csv_column(walls, "depth").front(),
            testing::measure_of(summary, "push", "plate_depth"));
  EXPECT_EQ(testing::csv_column(walls, "travel").front(),
            testing::csv_column(folder.path() / "series.csv", "travel.plate").back());
}

TEST(WallsInRuns, TheIndexOfAPlateGrowsWithItsTravel) {
  const testing::ScratchFolder folder;
  run(plate(), {.folder = folder.path()});
  const fs::path series = folder.path() / "series.csv";
  const auto index = testing::csv_column(series, "index.plate");
  const auto travel = testing::csv_column(series, "travel.plate");
  EXPECT_EQ(index.front(), 0);
  EXPECT_GT(index.back(), 0);
  for (std::size_t i = 1; i < travel.size(); ++i) {
    EXPECT_GE(travel[i], travel[i - 1]);
    EXPECT_LE(travel[i], travel[i - 1] + 1);
  }
}

TEST(WallsInRuns, AWallIsNotInsertedInsideParticles) {
  const testing::ScratchFolder folder;
  const auto scene = plate({"walls.plate.box=[12, 5, 18, 80]", "walls.plate.motion.distance=2"});
  EXPECT_THAT(
      [&] { run(scene, {.folder = folder.path()}); },
      ::testing::ThrowsMessage<scene::SceneError>(::testing::AllOf(
          ::testing::StartsWith("plate.yaml:13:13: error: stages.push.insert: wall plate would"),
          HasSubstr("inside particles"))));
}

TEST(WallsInRuns, AShakenStageEndsAfterItsCyclesWithARowForEach) {
  const testing::ScratchFolder folder;
  const auto summary = run(scene::parse(kShaken, "shaken.yaml"), {.folder = folder.path()});
  EXPECT_EQ(summary.stages[1].end_reason, "cycles");
  const fs::path cycles = folder.path() / "cycles.csv";
  EXPECT_EQ(testing::csv_column(cycles, "cycle"), (std::vector<double>{0, 1, 2, 3, 4, 5}));
  EXPECT_EQ(testing::csv_column(cycles, "step").back(), static_cast<double>(summary.steps));
  EXPECT_EQ(testing::csv_column(cycles, "intruder_height_rel").back(),
            testing::measure_of(summary, "shaking", "intruder_height_rel"));
  EXPECT_TRUE(fs::exists(folder.path() / "convection-shaking.csv"));
  EXPECT_FALSE(fs::exists(folder.path() / "convection-packing.csv"));
  EXPECT_FALSE(fs::exists(folder.path() / "contacts-shaking.csv"));
}

TEST(WallsInRuns, CyclesAreThoseOfTheSlowestWallInTheStageAlone) {
  const testing::ScratchFolder folder;
  const auto scene = scene::parse(R"(clca: 1
box: {width: 40, height: 40}
species: {grain: {shape: {hexagon: 0}}}
walls:
  quick: {box: [4, 20, 8, 22], motion: {wave: {form: triangle, amplitude: 2, period: 10}}}
  slow: {box: [20, 20, 24, 22], motion: {wave: {form: triangle, amplitude: 2, period: 40}}}
stages:
  - {name: one, fill: {region: [0, 0, 40, 4], counts: {grain: 3}}, move: [quick], until: {cycles: 7}}
  - {name: both, move: [quick, slow], until: {cycles: 2}}
)",
                                  "cycles.yaml");
  const auto summary = run(scene, {.folder = folder.path()});
  EXPECT_EQ(summary.stages[0].steps, 70U);
  EXPECT_EQ(summary.stages[1].steps, 80U);
}

TEST(WallsInRuns, WindowsOfFieldsFollowOneAnotherAndTheLastEndsWithTheStage) {
  const testing::ScratchFolder folder;
  const auto summary = run(scene::parse(kShaken, "shaken.yaml"), {.folder = folder.path()});
  const auto steps = testing::csv_column(folder.path() / "fields.csv", "step");
  EXPECT_EQ(steps.back(), static_cast<double>(summary.steps));
  EXPECT_TRUE(std::is_sorted(steps.begin(), steps.end()));
  EXPECT_EQ(steps.front(), 20);
  EXPECT_GT(testing::measure_of(summary, "shaking", "fluctuation_energy"), 0);
}

TEST(WallsInRuns, PicturesWithOverlaysAndByForceDoNotChangeTheRun) {
  const testing::ScratchFolder folder;
  const auto bare = run(plate(), {.folder = folder.path() / "bare"});
  const auto drawn =
      run(plate({"output.frames={every: 50, width: 160, height: 240, overlay: forces, "
                 "color_by: force}"}),
          {.folder = folder.path() / "drawn"});
  EXPECT_EQ(drawn.state_hash, bare.state_hash);
}

TEST(WallsInRuns, ASceneWithoutThemHasNoneOfTheirMeasures) {
  const testing::ScratchFolder folder;
  const auto summary =
      run(testing::bare_scene("heap", {"sources.spout.count=20"}), {.folder = folder.path()});
  for (const auto& [name, value] : summary.stages.back().measures) {
    EXPECT_THAT(name, ::testing::Not(::testing::AnyOf(HasSubstr("overlap"), HasSubstr("convection"),
                                                      HasSubstr("intruder"))));
  }
}

}  // namespace
}  // namespace clca::run::walls_test
