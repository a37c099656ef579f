// What probes see, in boxes small enough to count by hand.

#include <gtest/gtest.h>

#include <array>

#include "clca/measure/field_grid.hpp"
#include "support/states.hpp"

namespace clca::measure::probe_test {
namespace {

using grains::State;
using lattice::Shape;

/// Single sites, at rest where they are.
State points(const std::vector<lattice::Site>& sites, bool periodic = false) {
  State state{.lattice = lattice::Lattice(10, 20, periodic)};
  state.kinds = {{Shape::hexagon(0), 0}};
  for (const lattice::Site site : sites) {
    state.particles.push_back({.column = site.column, .row = site.row});
  }
  state.origins = sites;
  return state;
}

constexpr lattice::Rectangle kLow = {0, 0, 100, 10};  // its middle line: y = 5

double filling(const grains::State& state, const lattice::Rectangle& region) {
  return filled_shares(state, std::array{region}).front();
}

TEST(Filling, IsTheShareOfTheSitesWithoutWalls) {
  State state = points({{0, 0}, {0, 1}, {0, 12}});
  EXPECT_DOUBLE_EQ(filling(state, {0, 0, 0.5, 10}), 0.2);  // one column of ten sites
  state.walls = {{.sites = {{0, 4}, {0, 5}, {0, 15}}}};
  EXPECT_DOUBLE_EQ(filling(state, {0, 0, 0.5, 10}), 0.25);
  EXPECT_EQ(filling(state, {0, 4, 0.5, 6}), 0);  // walls only
}

TEST(MotionIn, IsWeightedBySites) {
  const Eigen::Vector2d inside(1, 1);
  const std::vector<Displacement> displacements = {{.from = inside, .vector = {0, -4}, .sites = 1},
                                                   {.from = inside, .vector = {0, 0}, .sites = 3},
                                                   {.from = {1, 11}, .vector = {9, 9}, .sites = 5}};
  const auto motion = region_motion(kLow, displacements, 2);
  ASSERT_TRUE(motion);
  EXPECT_EQ(motion->particles, 2U);
  EXPECT_DOUBLE_EQ(motion->velocity.y(), -0.5);
  EXPECT_DOUBLE_EQ(motion->fluctuation, 0.5 * (1 * 1.5 * 1.5 + 3 * 0.5 * 0.5) / 4);
  EXPECT_FALSE(region_motion({50, 50, 60, 60}, displacements, 2));
}

TEST(DownwardFlow, CountsWhatHasPassedTheMiddleEitherWay) {
  State state = points({{0, 6}, {2, 6}, {4, 3}, {6, 9}});
  const Snapshot before(state);
  state.particles[0].row = 4;
  state.particles[1].row = 4;
  EXPECT_EQ(sites_moved_down(before, state, kLow), 2);
  state.particles[2].row = 7;  // upwards
  state.particles[3].row = 6;  // not as far
  EXPECT_EQ(sites_moved_down(before, state, kLow), 1);
  EXPECT_EQ(sites_moved_down(before, state, {0, 0, 1, 10}), 1);  // the first only
}

TEST(DownwardFlow, CountsWhatHasEnteredOrLeftSince) {
  State state = points({{0, 6}, {2, 6}});
  state.particles[1].present = false;  // before
  const Snapshot before(state);
  state.particles[0].row = 1;
  state.particles[0].present = false;  // removed below the line
  state.particles.push_back({.column = 4, .row = 2});
  state.origins.push_back({4, 9});  // came in above it
  state.particles.push_back({.column = 6, .row = 2});
  state.origins.push_back({6, 3});  // below
  EXPECT_EQ(sites_moved_down(before, state, kLow), 2);
}

TEST(DownwardFlow, FollowsAParticleAcrossThePeriodicBoundary) {
  State state = points({{9, 6}}, true);
  const Snapshot before(state);
  state.particles[0].column = 14;  // column 4 of the box
  state.particles[0].row = 0;
  EXPECT_EQ(sites_moved_down(before, state, {0, 0, 5, 10}), 1);
  EXPECT_EQ(sites_moved_down(before, state, {5, 0, 8.6, 10}), 0);
}

TEST(MotionIn, AGrainOnTheEdgeOfAProbeIsInItInEveryImage) {
  for (int image = -40; image <= 40; ++image) {
    State state = points({{10 * image, 5}}, true);
    state.kinds = {{Shape::hexagon(2), 0}};
    const Snapshot before(state);
    state.step = 1;
    EXPECT_TRUE(region_motion({0, 0, 4, 10}, before.displacements(state), 1));
    state.particles[0].row = 2;
    EXPECT_EQ(sites_moved_down(before, state, {0, 0, 4, 7}), 19);
  }
}

}  // namespace
}  // namespace clca::measure::probe_test
