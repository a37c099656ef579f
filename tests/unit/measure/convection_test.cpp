#include "clca/measure/convection.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "support/states.hpp"

namespace clca::measure::convection_test {
namespace {

using grains::State;
using lattice::kColumnPitch;
using lattice::Shape;
using lattice::Site;

State single_sites(int columns, int rows) {
  State state = testing::empty_state(columns, rows);
  state.kinds = {{Shape::hexagon(0), 0}};
  return state;
}

/// Columns 0 to 17 in a box of 18, twelve high.
State bed() {
  State state = single_sites(18, 40);
  for (int column = 0; column < 18; ++column) {
    for (int row = 4; row < 16; ++row) {
      state.particles.push_back(testing::particle_at(column, row));
    }
  }
  return state;
}

/// The middle third goes up by one, the outer sixths down; all by `drift` more.
State rolled(State state, int drift) {
  for (grains::Particle& particle : state.particles) {
    const bool inside = particle.column >= 6 && particle.column < 12;
    const bool at_walls = particle.column < 3 || particle.column >= 15;
    particle.row += drift + (inside ? 1 : at_walls ? -1 : 0);
  }
  return state;
}

ConvectionRolls rolls_between(const State& begin, const State& end) {
  Convection convection(begin.lattice, 5);
  convection.begin_cycle(begin);
  convection.end_cycle(end);
  return convection.rolls().value();
}

TEST(Convection, UpInsideAndDownAtTheWallsIsPositive) {
  const ConvectionRolls rolls = rolls_between(bed(), rolled(bed(), 0));
  EXPECT_NEAR(rolls.centre_minus_wall, 2, 1e-12);
  EXPECT_GT(rolls.rotation_left, 0.01);
  EXPECT_NEAR(rolls.rotation_right, -rolls.rotation_left, 1e-12);
  const ConvectionRolls back = rolls_between(rolled(bed(), 0), bed());
  EXPECT_NEAR(back.centre_minus_wall, -2, 1e-12);
  EXPECT_LT(back.rotation_left, -0.01);
}

TEST(Convection, ADriftOfTheWholeBedDropsOut) {
  const ConvectionRolls plain = rolls_between(bed(), rolled(bed(), 0));
  const ConvectionRolls lifted = rolls_between(bed(), rolled(bed(), 7));
  EXPECT_NEAR(lifted.centre_minus_wall, plain.centre_minus_wall, 1e-12);
  EXPECT_NEAR(lifted.rotation_left, plain.rotation_left, 1e-12);
  EXPECT_NEAR(lifted.rotation_right, plain.rotation_right, 1e-12);
}

/// Adds a ring of six sites, turned clockwise by `sixths`.
void add_ring(State& state, Site centre, int sixths) {
  for (const lattice::Direction direction : lattice::kDirections) {
    const Site site = centre + unit(rotated(direction, sixths));
    state.particles.push_back(testing::particle_at(site.column, site.row));
  }
}

State rings(int sixths) {
  State state = single_sites(6, 20);
  add_ring(state, {1, 10}, -sixths);
  add_ring(state, {4, 10}, sixths);
  return state;
}

// A turn by 60 degrees displaces by (cos 60 - 1) r along r and sin 60 r across. Of the two sites of
// a ring inside, one goes up by 1 and one by 1/2; at the wall, down.
TEST(Convection, TwoRingsTurnAgainstEachOther) {
  const ConvectionRolls rolls = rolls_between(rings(0), rings(1));
  const double sine = std::sqrt(3.0) / 2;
  EXPECT_NEAR(rolls.rotation_left, sine, 1e-12);
  EXPECT_NEAR(rolls.rotation_right, -sine, 1e-12);
  EXPECT_NEAR(rolls.centre_minus_wall, 1.5, 1e-12);
}

TEST(Convection, ArrowsAreMeansPerCycle) {
  State state = single_sites(6, 20);
  state.particles = {testing::particle_at(2, 5), testing::particle_at(3, 15)};
  Convection convection(state.lattice, 10);  // cells: rows 0 to 9, rows 10 to 19
  for (const int up : {1, 2}) {
    convection.begin_cycle(state);
    state.particles[0].row += up;
    convection.end_cycle(state);
  }
  EXPECT_EQ(convection.completed_cycles(), 2U);
  const auto arrows = convection.arrows();
  ASSERT_EQ(arrows.size(), 2U);
  EXPECT_NEAR(arrows[0].displacement.y(), 1.5, 1e-12);
  EXPECT_NEAR(arrows[0].centre.y(), -0.5 + 20.5 / 4, 1e-12);
  EXPECT_NEAR(arrows[0].centre.x(), 2.5 * kColumnPitch, 1e-12);
  EXPECT_EQ(arrows[0].weight, 2);
  EXPECT_NEAR(arrows[1].displacement.norm(), 0, 1e-12);
}

TEST(Convection, LeavesOutWhatCameOrLeftAndWhatIsBetweenCycles) {
  State state = bed();
  Convection convection(state.lattice, 5);
  EXPECT_FALSE(convection.rolls().has_value());
  convection.begin_cycle(state);
  state.particles[0].present = false;
  state.particles.push_back(testing::particle_at(5, 30));
  convection.end_cycle(state);
  state = rolled(state, 0);  // no cycle
  convection.begin_cycle(state);
  convection.end_cycle(state);
  double weight = 0;
  for (const ConvectionArrow& arrow : convection.arrows()) {
    EXPECT_NEAR(arrow.displacement.norm(), 0, 1e-12);
    weight += arrow.weight;
  }
  EXPECT_EQ(weight, 2 * 215 + 1);
  EXPECT_EQ(convection.rolls()->centre_minus_wall, 0);
}

// Nine columns: those a third of the width from the middle one are at the walls, at both sides.
TEST(Convection, AColumnOnAnEdgeCountsAlikeOnBothSides) {
  for (int left = 0; left < 40; ++left) {
    State before = single_sites(60, 20);
    for (int column = left; column < left + 9; ++column) {
      before.particles.push_back(testing::particle_at(column, 5));
    }
    State after = before;
    after.particles[1].row += 1;
    after.particles[7].row += 1;
    EXPECT_NEAR(rolls_between(before, after).centre_minus_wall, -0.5, 1e-12) << left;
  }
}

TEST(Convection, ACycleEndsOnlyAfterItHasBegun) {
  const State state = bed();
  Convection convection(state.lattice, 5);
  EXPECT_THROW(convection.end_cycle(state), std::logic_error);
}

TEST(Snapshot, AJourneyBeginsInTheBoxAndRunsOnAcrossTheSeam) {
  State state = single_sites(12, 20);
  state.lattice = lattice::Lattice(12, 20, true);
  state.particles = {testing::particle_at(23, 5)};
  const Snapshot snapshot(state);
  state.particles[0].column = 25;
  const auto displacements = snapshot.displacements(state);
  ASSERT_EQ(displacements.size(), 1U);
  EXPECT_TRUE(displacements[0].from.isApprox(Eigen::Vector2d(11 * kColumnPitch, 5.5)));
  EXPECT_TRUE(displacements[0].vector.isApprox(Eigen::Vector2d(2 * kColumnPitch, 0)));
}

}  // namespace
}  // namespace clca::measure::convection_test
