#include "clca/measure/weight_paths.hpp"

#include <gtest/gtest.h>

#include "support/states.hpp"

namespace clca::measure::weight_paths_test {
namespace {

using Eigen::Vector2d;
using grains::Occupancy;
using testing::particle_at;

constexpr int kHalf = 40;  // columns

/// A wedge of one-site grains, its flanks along lattice directions: the top falls by half a spacing
/// from column to column.
grains::State wedge() {
  grains::State state = testing::empty_state(2 * kHalf + 1, kHalf);
  state.kinds = {{lattice::Shape::hexagon(0), 0}};
  for (int column = 0; column <= 2 * kHalf; ++column) {
    const int top = kHalf - std::abs(column - kHalf);  // twice the height
    for (int row = 0; lattice::doubled_height({column, row}) <= top; ++row) {
      state.particles.push_back(particle_at(column, row));
    }
  }
  return state;
}

grains::State settled_bed() {
  automaton::Automaton automaton = testing::mixed_automaton(60, 120, 120);
  testing::settle(automaton);
  return automaton.grains();
}

WeightPaths paths(const grains::State& state, WeightRule rule) {
  return weight_paths(state, supported_grains(state, Occupancy(state)), rule);
}

/// Vertical forces on the floor, by column.
std::vector<double> floor_forces(const grains::State& state, WeightRule rule) {
  std::vector<double> result(static_cast<std::size_t>(state.lattice.columns()), 0);
  for (const contact::Force& force : paths(state, rule).forces) {
    if (force.other == contact::kFloor) {
      result[static_cast<std::size_t>(state.particles[force.upper].column)] += force.on_upper().y();
    }
  }
  return result;
}

TEST(WeightPaths, InnerPutsEachColumnOfARegularStackOnItsOwnFoot) {
  const grains::State state = wedge();
  const std::vector<double> forces = floor_forces(state, WeightRule::inner);
  std::vector<double> heights(forces.size(), 0);
  for (const grains::Particle& grain : state.particles) {
    ++heights[static_cast<std::size_t>(grain.column)];
  }
  for (std::size_t column = 0; column < heights.size(); ++column) {
    EXPECT_NEAR(forces[column], heights[column], 1e-9) << column;
  }
}

// Forces go along the two sloping directions, and grow by 1 with each grain. The two lines up from
// a foot have the same number of grains together, wherever it is.
TEST(WeightPaths, OuterMakesThePressureBelowARegularStackFlat) {
  const grains::State state = wedge();
  const std::vector<double> forces = floor_forces(state, WeightRule::outer);
  for (std::size_t column = 0; column < forces.size(); ++column) {
    // A grain at half a spacing stands on those beside it.
    EXPECT_NEAR(forces[column], column % 2 == 0 ? (kHalf + 2) / 2.0 : 0, 1e-9) << column;
  }
}

// On average each grain passes on a third in each of three directions, so the pressure is that of
// the columns, spread by some 3 spacings: 0.875 of the top in the inner half, 0.625 in the next.
// 40 seeds; one of them scatters by 0.2.
TEST(WeightPaths, DrawnSharesMakeAHump) {
  grains::State state = wedge();
  double inside = 0;
  double beside = 0;
  for (state.seed = 1; state.seed <= 40; ++state.seed) {
    const std::vector<double> forces = floor_forces(state, WeightRule::q);
    for (int column = 0; column < static_cast<int>(forces.size()); ++column) {
      const int off = std::abs(column - kHalf);
      const double force = forces[static_cast<std::size_t>(column)];
      inside += off < kHalf / 4 ? force : 0;
      beside += off > kHalf / 4 && off < kHalf / 2 ? force * (kHalf / 2 - 1) / (kHalf / 2 - 2) : 0;
    }
  }
  EXPECT_NEAR(inside / beside, 0.875 / 0.625, 0.15);
}

TEST(WeightPaths, TheBaseBearsTheWholeWeightByEachRule) {
  const grains::State state = settled_bed();
  for (const WeightRule rule : kWeightRules) {
    const WeightPaths found = paths(state, rule);
    Vector2d sum = Vector2d::Zero();
    for (const contact::Force& force : found.forces) {
      sum += grains::is_particle(force.other) ? Vector2d::Zero() : force.on_upper();
    }
    EXPECT_EQ(found.unsupported_grains, 0);
    EXPECT_NEAR(sum.y(), static_cast<double>(state.particles.size()), 1e-9);
  }
}

TEST(WeightPaths, ASupportIsNeverPulled) {
  const grains::State state = settled_bed();
  for (const SupportedGrain& grain : supported_grains(state, Occupancy(state))) {
    for (const auto& support : grain.supports) {
      EXPECT_LT(support.direction.y(), -0.05);
      EXPECT_NEAR(support.direction.norm(), 1, 1e-12);
    }
  }
  for (const WeightRule rule : kWeightRules) {
    for (const contact::Force& force : paths(state, rule).forces) {
      EXPECT_GT(force.on_upper().y(), 0);
    }
  }
}

TEST(WeightPaths, DirectionsOfAPairAreOpposite) {
  const grains::State state = settled_bed();
  const Occupancy occupancy(state);
  std::size_t pairs = 0;
  for (std::uint32_t id = 0; id < state.particles.size(); ++id) {
    for (const auto& [body, sum] : touched_bodies(state, occupancy, id)) {
      if (grains::is_particle(body)) {
        const auto back = touched_bodies(state, occupancy, grains::particle_id(body));
        EXPECT_EQ(back.at(grains::as_owner(id)) + sum, lattice::Axial());
        ++pairs;
      }
    }
  }
  EXPECT_GT(pairs, 2 * state.particles.size());
}

TEST(WeightPaths, TheSeedChangesOnlyWhatIsDrawn) {
  const grains::State state = settled_bed();
  grains::State other = state;
  ++other.seed;
  for (const WeightRule rule : kWeightRules) {
    const bool is_drawn = rule == WeightRule::pair || rule == WeightRule::q;
    EXPECT_EQ(paths(state, rule).forces, paths(state, rule).forces);
    EXPECT_EQ(paths(state, rule).forces != paths(other, rule).forces, is_drawn);
  }
}

// The wall is below, to the left; the other grain has nothing below it.
TEST(WeightPaths, CountsGrainsWhoseForceNothingHoldsOnOneSide) {
  grains::State state = testing::empty_state(10, 10);
  state.kinds = {{lattice::Shape::hexagon(0), 0}};
  state.walls = {{.sites = {{4, 3}}}};
  state.particles = {particle_at(5, 3), particle_at(8, 3)};
  for (const WeightRule rule : kWeightRules) {
    const WeightPaths found = paths(state, rule);
    EXPECT_EQ(found.one_sided_grains, rule == WeightRule::q ? 0 : 1);
    EXPECT_EQ(found.unsupported_grains, 1);
    ASSERT_EQ(found.forces.size(), 1);
    EXPECT_EQ(found.forces.front().other, grains::wall_code(0));
    EXPECT_NEAR((found.forces.front().on_upper() - Vector2d(0, 1)).norm(), 0, 1e-12);
  }
}

TEST(WeightPaths, ThePressureIsOverItsMeanAndOfTheBaseOnly) {
  const BedBase base = {.left = 0, .right = 13};
  std::vector<contact::Force> forces;
  for (int i = 0; i < BedBase::kBinCount; ++i) {
    forces.push_back({.other = contact::kFloor,
                      .point = {i + 0.5, 0},
                      .normal = {0, 1},
                      .normal_force = i == 6 ? 5.0 : 2.0});
  }
  forces.push_back(
      {.other = contact::kFloor, .point = {13.5, 0}, .normal = {0, 1}, .normal_force = 9});
  forces.push_back(
      {.other = contact::kLeftSide, .point = {0, 3}, .normal = {1, 0}, .shear_force = 9});
  forces.push_back({.other = 3, .point = {6, 3}, .normal = {0, 1}, .normal_force = 9});
  const std::vector<double> pressure = base_pressures(base, forces);
  ASSERT_EQ(pressure.size(), 13);
  EXPECT_DOUBLE_EQ(pressure[0], 2 * 13 / 29.0);
  EXPECT_DOUBLE_EQ(centre_minus_ring(pressure), 3 * 13 / 29.0);
  EXPECT_TRUE(base_pressures(base, {}).empty());
}

TEST(WeightPaths, BothEndsBelongToTheBaseAndHalfOfWhatIsBetweenTwoBinsToEach) {
  for (const int columns : {13, 14}) {
    std::vector<contact::Force> forces;
    for (int column = 0; column < columns; ++column) {
      forces.push_back({.other = contact::kFloor,
                        .point = {lattice::kColumnPitch * column, 0},
                        .normal = {0, 1},
                        .normal_force = 3});
    }
    const std::vector<double> pressure =
        base_pressures({.left = 0, .right = lattice::kColumnPitch * (columns - 1)}, forces);
    const double end = columns == 13 ? 1 : 1.5 * 13 / 14;  // the whole of one, half of the next
    EXPECT_NEAR(pressure.front(), end, 1e-12) << columns;
    EXPECT_NEAR(pressure.back(), end, 1e-12) << columns;
  }
}

TEST(WeightPaths, TheBaseLeavesOutAHundredthOfTheSitesOnEitherSide) {
  const grains::State state = wedge();
  const BedBase base = bed_base(state);
  std::size_t left = 0;
  for (const grains::Particle& grain : state.particles) {
    left += lattice::kColumnPitch * grain.column < base.left ? 1U : 0U;
  }
  EXPECT_LE(left, state.particles.size() / 100);
  EXPECT_NEAR(base.left + base.right, 2 * kHalf * lattice::kColumnPitch, 1e-9);
}

TEST(WeightPaths, RefusesParticlesThatMayOverlap) {
  grains::State state = wedge();
  state.walls = {{.sites = {{0, kHalf - 1}},
                  .motion = grains::WallMotion{.direction = lattice::Direction::down,
                                               .program = grains::Drive{}},
                  .passive_rule = grains::PassiveRule::overlap}};
  EXPECT_THROW(supported_grains(state, Occupancy(state)), std::invalid_argument);
}

}  // namespace
}  // namespace clca::measure::weight_paths_test
