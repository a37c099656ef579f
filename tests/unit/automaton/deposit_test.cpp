// Packings that are at rest from the beginning.

#include <gtest/gtest.h>

#include "clca/automaton/automaton.hpp"
#include "clca/lattice/region.hpp"

namespace clca::automaton::deposit_test {
namespace {

using grains::FillResult;
using grains::Occupancy;
using grains::Particle;
using grains::State;
State mixed_box(int columns, int rows, bool periodic = false) {
  State state{.lattice = lattice::Lattice(columns, rows, periodic), .seed = 7};
  state.kinds = {{lattice::Shape::hexagon(1), 0},
                 {lattice::Shape::hexagon(2), 1},
                 {lattice::Shape::rod(0, 4), 2},
                 {lattice::Shape::rod(0, 4).rotated(1), 2},
                 {lattice::Shape::rod(0, 4).rotated(2), 2},
                 {lattice::Shape::hexagon(5), 3}};
  return state;
}

TEST(Deposit, IsAtRestWhereverItLies) {
  for (const bool periodic : {false, true}) {
    Automaton automaton(mixed_box(60, 200, periodic));
    const std::vector<std::size_t> counts = {120, 80, 50, 5};
    const FillResult result = automaton.fill({0, 0, 60, 200}, counts, true);
    EXPECT_TRUE(result.complete);
    EXPECT_EQ(result.placed_by_species, counts);
    EXPECT_EQ(automaton.state().particles.size(), 255U);
    EXPECT_EQ(Occupancy(automaton.state()), automaton.occupancy());
    const State before = automaton.state();
    EXPECT_TRUE(automaton.step().settled) << periodic;
    EXPECT_EQ(automaton.state().particles, before.particles);
  }
}

TEST(Deposit, StaysInItsRegionAndOnTopOfWhatIsThere) {
  Automaton automaton(mixed_box(60, 120));
  const lattice::Rectangle low = {10, 0, 40, 60};
  automaton.fill(low, std::vector<std::size_t>{60, 0, 0, 0}, true);
  const lattice::Rectangle high = {5, 20, 45, 100};
  automaton.fill(high, std::vector<std::size_t>{0, 30, 0, 2}, true);
  for (const Particle& particle : automaton.state().particles) {
    for (const lattice::Axial part : automaton.state().shape(particle).sites()) {
      const Eigen::Vector2d at = lattice::position(particle.site() + part);
      EXPECT_TRUE((particle.kind == 0 ? low : high).contains(at)) << at.transpose();
    }
  }
  EXPECT_EQ(Occupancy(automaton.state()), automaton.occupancy());
}

TEST(Deposit, WhatFindsNoRoomIsCountedAndTheRestGoesOn) {
  Automaton automaton(mixed_box(20, 40));
  const FillResult result =
      automaton.fill({0, 0, 20, 40}, std::vector<std::size_t>{1000, 0, 0, 1}, true);
  EXPECT_FALSE(result.complete);
  EXPECT_GT(result.placed_by_species[0], 40U);
  EXPECT_LT(result.placed_by_species[0], 120U);
  EXPECT_EQ(automaton.fill({0, 0, 3, 40}, std::vector<std::size_t>{0, 0, 0, 1}, true)
                .placed_by_species[3],
            0U)
      << "narrower than the particle";
}

TEST(Deposit, MixesTheSpeciesUpToTheTop) {
  Automaton automaton(mixed_box(100, 300));
  automaton.fill({0, 0, 87, 300}, std::vector<std::size_t>{600, 600, 0, 0}, true);
  std::array<double, 2> height = {};
  for (const Particle& particle : automaton.state().particles) {
    height[particle.kind] += particle.row / 600.0;
  }
  EXPECT_NEAR(height[0] / height[1], 1, 0.1);
}

TEST(Deposit, ComesDownOnly) {
  Automaton automaton(mixed_box(20, 20), {.gravity = lattice::Direction::up});
  EXPECT_THROW(automaton.fill({0, 0, 20, 20}, std::vector<std::size_t>{1, 0, 0, 0}, true),
               std::invalid_argument);
}

}  // namespace
}  // namespace clca::automaton::deposit_test
