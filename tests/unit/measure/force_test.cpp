#include "clca/measure/force.hpp"

#include <gtest/gtest.h>

#include <utility>

#include "pushed_states.hpp"

namespace clca::measure::force_test {
namespace {

using grains::Occupancy;
using grains::State;
using lattice::Direction;

ForceSummary summary_of(const State& state) {
  const Occupancy occupancy(state);
  return force_summary(state, occupancy, overlap_contacts(state, occupancy));
}

/// The state with one more pair that shares the site (column, row).
std::optional<double> cone_share_with(int column, int row) {
  State state = testing::pushed_state();
  testing::add_pair(state, column, row);
  return summary_of(state).cone_share;
}

TEST(Force, SumsUpTheContactsOfAPlate) {
  State state = testing::pushed_state();
  state.particles[1].previous = 3;
  state.walls[0].travel.stalls = 4;
  state.walls[0].travel.stalled_since = 17;
  const ForceSummary summary = summary_of(state);
  EXPECT_EQ(summary.max_depth, 1);
  EXPECT_EQ(summary.shared_sites, 2U);
  EXPECT_EQ(summary.contact_count, 2U);
  EXPECT_EQ(summary.jammed_particles, 1U);
  EXPECT_DOUBLE_EQ(summary.cone_share.value(), 1);
  ASSERT_EQ(summary.walls.size(), 1U);
  const WallOverlap& wall = summary.walls[0];
  EXPECT_EQ(wall.wall, 0U);
  EXPECT_EQ(wall.travel, 0);
  EXPECT_EQ(wall.stalled_since, 17U);
  EXPECT_EQ(wall.stalls, 4U);
  EXPECT_EQ(wall.overlapping_particles, 1U);
  EXPECT_EQ(wall.shared_sites, 1U);
  EXPECT_EQ(wall.chain_sites, 2U);
  EXPECT_EQ(wall.jammed_particles, 1U);
}

TEST(Force, OfAnIdlePlateIsNothing) {
  State state = testing::pushed_state();
  state.particles.clear();
  state.pushes.clear();
  state.walls.insert(state.walls.begin(), grains::Wall{.sites = {{0, 0}}});
  const ForceSummary summary = summary_of(state);
  EXPECT_EQ(summary.shared_sites, 0U);
  EXPECT_FALSE(summary.cone_share.has_value());
  ASSERT_EQ(summary.walls.size(), 1U);  // the one that does not move is left out
  EXPECT_EQ(summary.walls[0].wall, 1U);
  EXPECT_EQ(summary.walls[0].chain_sites, 0U);
}

TEST(Force, CountsAParticlePushedTwiceAsOneJammed) {
  State state = testing::pushed_state();
  state.particles.push_back(testing::particle_at(12, 9));  // shares one site with particle 1
  state.pushes.push_back({.pushed = 1, .pusher = 2});
  EXPECT_EQ(summary_of(state).jammed_particles, 2U);
}

TEST(Force, KeepsTheChainsOfTwoPlatesApart) {
  State state = testing::pushed_state();
  state.walls.push_back(testing::plate({{30, 30}}));
  testing::add_pair(state, 30, 20);
  state.pushes.back().source = 1;
  const ForceSummary summary = summary_of(state);
  ASSERT_EQ(summary.walls.size(), 2U);
  EXPECT_EQ(summary.walls[0].chain_sites, 2U);
  EXPECT_EQ(summary.walls[1].chain_sites, 1U);
  EXPECT_EQ(summary.walls[1].shared_sites, 0U);
  EXPECT_EQ(summary.walls[1].jammed_particles, 1U);
}

// The plate ends at x = 12 columns; four spacings below it the cone reaches to 12 + 4 / 0.866 =
// 16.6 columns. Upwards it ends one spacing behind the foremost site, at row 13.
TEST(Force, TheConeOpensAt45DegreesAheadOfThePlate) {
  EXPECT_DOUBLE_EQ(cone_share_with(16, 8).value(), 1);
  EXPECT_DOUBLE_EQ(cone_share_with(17, 8).value(), 0.5);
  EXPECT_DOUBLE_EQ(cone_share_with(4, 8).value(), 1);
  EXPECT_DOUBLE_EQ(cone_share_with(3, 8).value(), 0.5);
  EXPECT_DOUBLE_EQ(cone_share_with(10, 15).value(), 0.5);
}

TEST(Force, TheConeOpensTheWayOfThePush) {
  State state = testing::pushed_state();
  testing::add_pair(state, 10, 15);
  state.pushes.back().direction = Direction::up;
  EXPECT_DOUBLE_EQ(summary_of(state).cone_share.value(), 1);
}

TEST(Force, TheConeRunsOnAcrossASeam) {
  State state = testing::pushed_state();
  state.walls[0].sites = testing::row_of_sites(0, 2, 12);
  state.particles.clear();
  state.pushes.clear();
  testing::add_pair(state, 38, 8);
  EXPECT_DOUBLE_EQ(summary_of(state).cone_share.value(), 0);
  state.lattice = lattice::Lattice(40, 40, true);
  EXPECT_DOUBLE_EQ(summary_of(state).cone_share.value(), 1);
  state.walls[0].travel.offset = 5;  // below the pair
  EXPECT_DOUBLE_EQ(summary_of(state).cone_share.value(), 0);
}

TEST(Penetration, IsTheDepthOfTheForemostPointUnderTheOldSurface) {
  State state = testing::pushed_state();
  grains::Wall& plate = state.walls[0];
  const std::vector<double> flat(40, 10.0);
  EXPECT_DOUBLE_EQ(penetration_depth(state, plate, flat).value(), -2);
  plate.travel.offset = 4;  // its lower edge is 8 above the floor
  EXPECT_DOUBLE_EQ(penetration_depth(state, plate, flat).value(), 2);
  std::vector<double> hilly(40, 100.0);
  for (const auto& [column, height] : {std::pair(8U, 9.0), {9U, 9.0}, {10U, 9.0}, {11U, 14.0}}) {
    hilly[column] = height;
  }
  hilly[12] = 0;
  EXPECT_DOUBLE_EQ(penetration_depth(state, plate, hilly).value(), 2.25);
}

TEST(Penetration, OfAPlateThatRisesIsToItsUpperEdge) {
  State state = testing::pushed_state();
  state.walls[0] = testing::plate(testing::row_of_sites(8, 12, 0), Direction::up);
  state.walls[0].travel.offset = 3;  // odd columns end at 4.5
  EXPECT_DOUBLE_EQ(penetration_depth(state, state.walls[0], std::vector<double>(40, 10.0)).value(),
                   5.5);
}

TEST(Penetration, IsNoneForAWallOverNoBedOrOneThatMovesSideways) {
  State state = testing::pushed_state();
  grains::Wall plate = state.walls[0];
  EXPECT_FALSE(penetration_depth(state, plate, std::vector<double>(40, 0.0)).has_value());
  const std::vector<double> flat(40, 10.0);
  plate.motion->direction = Direction::down_left;
  EXPECT_FALSE(penetration_depth(state, plate, flat).has_value());
  plate.motion.reset();
  EXPECT_FALSE(penetration_depth(state, plate, flat).has_value());
}

}  // namespace
}  // namespace clca::measure::force_test
