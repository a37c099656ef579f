// Measures refuse what does not belong together.

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

#include "clca/measure/convection.hpp"
#include "clca/measure/displacement.hpp"
#include "clca/measure/field_grid.hpp"
#include "clca/measure/force.hpp"
#include "clca/measure/outflow.hpp"
#include "clca/measure/profile.hpp"
#include "pushed_states.hpp"

namespace clca::measure::preconditions_test {
namespace {

using grains::Occupancy;
using grains::State;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

State two_particles() {
  State state = testing::empty_state(20, 20);
  state.kinds = {{lattice::Shape::hexagon(1), 0}};
  state.particles = {testing::particle_at(5, 5), testing::particle_at(5, 9)};
  state.origins = {{5, 5}, {5, 9}};
  return state;
}

TEST(AGrid, HasCellsThatArePositiveAndNotTooMany) {
  const lattice::Lattice lattice(20, 20, false);
  for (const double wrong : {0.0, -1.0, kNaN, 1e-9, 1e-300}) {
    EXPECT_THROW(Grid(lattice, wrong), std::invalid_argument) << wrong;
    EXPECT_THROW(Convection(lattice, wrong), std::invalid_argument) << wrong;
  }
  EXPECT_EQ(Grid(lattice, std::numeric_limits<double>::infinity()).size(), 1U);
}

TEST(ASnapshot, IsHeldAgainstAStateThatFollowedIt) {
  State begin = two_particles();
  begin.step = 5;
  State fewer = begin;
  fewer.particles.pop_back();
  State earlier = begin;
  earlier.step = 4;
  for (const State& wrong : {fewer, earlier}) {
    EXPECT_THROW(Snapshot(begin).displacements(wrong), std::invalid_argument);
    EXPECT_THROW(field_cells(Snapshot(begin), wrong, 5), std::invalid_argument);
    Convection convection(begin.lattice, 5);
    convection.begin_cycle(begin);
    EXPECT_THROW(convection.end_cycle(wrong), std::invalid_argument);
  }
}

TEST(ASnapshot, OfPlacesThatNoRunReachesIsRefused) {
  for (const int far : {std::numeric_limits<int>::min(), std::numeric_limits<int>::max()}) {
    State begin = two_particles();
    begin.particles[1].row = far;
    EXPECT_FALSE(Snapshot(begin).precedes(begin)) << far;
  }
  EXPECT_TRUE(Snapshot(two_particles()).precedes(two_particles()));
}

TEST(Displacements, NeedAnOriginOfEachParticle) {
  State state = two_particles();
  EXPECT_EQ(distances_from_origins(state).size(), 2U);
  EXPECT_THROW(moved_share(state, kNaN), std::invalid_argument);
  state.origins.pop_back();
  EXPECT_THROW(distances_from_origins(state), std::invalid_argument);
  EXPECT_THROW(moved_share(state, 1), std::invalid_argument);
  EXPECT_THROW(runout(state), std::invalid_argument);
}

TEST(Contacts, AreLookedUpInTheOccupancyOfTheirState) {
  const State state = testing::pushed_state();
  const Occupancy other(testing::empty_state(4, 4));
  EXPECT_THROW(overlap_contacts(state, other), std::invalid_argument);
  EXPECT_THROW(force_summary(state, other, {}), std::invalid_argument);
  EXPECT_THROW(is_clogged(state, other, 0, lattice::Direction::down), std::invalid_argument);
}

TEST(Contacts, OfParticlesThatAreNotThereAreRefused) {
  const State state = testing::pushed_state();
  EXPECT_THROW(force_indices(3, {{.first = 3, .second = 0}}), std::invalid_argument);
  EXPECT_THROW(force_indices(3, {{.first = 0, .second = 3}}), std::invalid_argument);
  EXPECT_THROW(force_summary(state, Occupancy(state), {{.first = 1'000'000, .second = 0}}),
               std::invalid_argument);
}

TEST(ForceDistributions, AreOfPositiveNumbers) {
  for (const double wrong : {0.0, -1.0, kNaN, 1e30}) {
    EXPECT_THROW(force_distribution({1, wrong}, StrengthKind::averaged), std::invalid_argument)
        << wrong;
    EXPECT_THROW(force_distribution({1, wrong}, StrengthKind::whole_sites), std::invalid_argument)
        << wrong;
  }
}

TEST(Penetration, NeedsTheSurfaceOfItsBox) {
  const State state = testing::pushed_state();
  EXPECT_THROW(penetration_depth(state, state.walls.at(0), {}), std::invalid_argument);
}

TEST(AnOutflow, DoesNotFlowBack) {
  Outflow outflow({.particles = 5, .sites = 35});
  EXPECT_THROW(outflow.add({.particles = 4, .sites = 28}), std::invalid_argument);
  outflow.add({.particles = 9, .sites = 35});
  EXPECT_EQ(outflow.sites_per_step(), 0) << "particles without sites";
}

TEST(AnEmptyProfile, HasNoFlanks) {
  EXPECT_FALSE(repose_angle({}).mean_degrees());
  EXPECT_EQ(mean_height({}), 0);
}

}  // namespace
}  // namespace clca::measure::preconditions_test
