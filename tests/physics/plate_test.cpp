// Plates and pistons that are pushed into a bed until they stall: how deep they come and how dense
// the bed gets. Numbers: an independent prototype's, 32 to 36 spacings of depth, 0.90 to 0.95
// packed. Single runs scatter widely, by 7 to 10 spacings and 0.045, so means are over 16.

#include <cmath>

#include "physics/seeds.hpp"

namespace clca::plate_test {
namespace {

constexpr int kSeeds = 16;

void expect_a_stall(const store::RunSummary& summary) {
  const std::string& stage = summary.stages.back().name;
  EXPECT_EQ(summary.stages.back().end_reason, "stalled");
  EXPECT_TRUE(std::isfinite(testing::measure_of(summary, stage, "stalled_since")));
  EXPECT_EQ(testing::measure_of(summary, stage, "overlap_depth_max"), 1);
}

// Depth: the middle of the prototype's window and 4 standard errors (2.5) to either side. Most of
// the overlap has to lie in the cone ahead: 16 seeds gave 0.893 with a standard error of 0.018, so
// 0.8 is 5 of them away.
TEST(Plate, StallsAtTheDepthOfThePrototypeWithMostOfTheOverlapInTheConeAhead) {
  std::vector<double> depths;
  std::vector<double> cone_shares;
  testing::for_seeds(kSeeds, "plate-penetration", {}, [&](const auto& summary, const auto&) {
    expect_a_stall(summary);
    depths.push_back(testing::measure_of(summary, "penetration", "plate_depth"));
    EXPECT_TRUE(std::isfinite(depths.back()));
    cone_shares.push_back(testing::measure_of(summary, "penetration", "overlap_cone_share"));
  });
  testing::expect_within("plate_depth", testing::sample(depths).mean, 24, 44);
  testing::expect_within("cone_share", testing::sample(cone_shares).mean, 0.8, 1);
}

// Packing: about the middle of the prototype's window, 4 standard errors (0.012) to either side.
TEST(Piston, StallsWithNoMoverWhenTheBedIsAsDenseAsInThePrototype) {
  std::vector<double> fractions;
  for (int seed = 1; seed <= kSeeds; ++seed) {
    scene::Scene scene = testing::bare_scene("piston", {fmt::format("seed={}", seed)});
    scene.output.series = scene::SeriesOutput{};
    const testing::ScratchFolder folder;
    const auto summary = run::run(scene, {.folder = folder.path()});
    expect_a_stall(summary);
    EXPECT_EQ(testing::csv_column(folder.path() / "series.csv", "moving").back(), 0);
    fractions.push_back(testing::measure_of(summary, "compression", "packing_fraction"));
  }
  testing::expect_within("packing_fraction", testing::sample(fractions).mean, 0.88, 0.98);
}

}  // namespace
}  // namespace clca::plate_test
