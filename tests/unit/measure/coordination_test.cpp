// How many bodies each particle touches.

#include <gtest/gtest.h>

#include "clca/measure/mixing.hpp"
#include "support/states.hpp"

namespace clca::measure::coordination_test {
namespace {

TEST(Coordination, CountsEachNeighbourOnceAndAllSidesAsOne) {
  // Three hexagons of seven sites: two on the floor beside each other, the left one beside the left
  // side, too; one far above; and a wall that touches the second with several sites.
  grains::State state = testing::empty_state(20, 20);
  state.kinds = {{lattice::Shape::hexagon(1), 0}};
  for (const lattice::Site site : {lattice::Site{1, 1}, {4, 1}, {10, 12}, {15, 12}}) {
    state.particles.push_back({.column = site.column, .row = site.row});
    state.origins.push_back(site);
  }
  state.particles.back().present = false;
  state.walls.push_back({.sites = {{6, 0}, {6, 1}, {6, 2}}});
  EXPECT_EQ(coordination_numbers(state, grains::Occupancy(state)), (std::vector<int>{2, 3, 0, 0}));
}

TEST(Coordination, LooksAcrossAPeriodicBoundary) {
  grains::State state = testing::empty_state(12, 12);
  state.lattice = lattice::Lattice(12, 12, true);
  state.kinds = {{lattice::Shape::hexagon(1), 0}};
  for (const lattice::Site site : {lattice::Site{1, 5}, {10, 5}}) {
    state.particles.push_back({.column = site.column, .row = site.row});
    state.origins.push_back(site);
  }
  EXPECT_EQ(coordination_numbers(state, grains::Occupancy(state)), (std::vector<int>{1, 1}));
}

}  // namespace
}  // namespace clca::measure::coordination_test
