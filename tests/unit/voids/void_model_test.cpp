#include "clca/voids/void_model.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "support/states.hpp"

namespace clca::voids::void_model_test {
namespace {

using testing::particle_at;

/// A box of 9 columns and 6 rows with grains of one site and two species.
grains::State box_with(const std::vector<grains::Particle>& particles) {
  grains::State state = testing::empty_state(9, 6);
  state.kinds = {{lattice::Shape::hexagon(0), 0}, {lattice::Shape::hexagon(0), 1}};
  state.particles = particles;
  for (const grains::Particle& particle : particles) {
    state.origins.push_back(particle.site());
  }
  return state;
}

TEST(VoidModel, LetsALoneGrainFallStraightToTheFloor) {
  VoidModel model(box_with({particle_at(4, 3)}));
  for (int row = 2; row >= 0; --row) {
    EXPECT_EQ(model.step().moved_count, 1);
    EXPECT_EQ(model.state().particles[0].site(), (lattice::Site{4, row}));
    EXPECT_EQ(model.state().particles[0].previous,
              static_cast<grains::Move>(lattice::Direction::down));
  }
  EXPECT_TRUE(model.step().settled);
  EXPECT_EQ(model.state().particles[0].previous, grains::kRest);
}

/// A row on the floor but for the site in column 4, and the three grains above that, in the order
/// straight above, left, right. The void there is the only one that can claim them.
grains::State notch() {
  std::vector<grains::Particle> particles = {particle_at(4, 1), particle_at(3, 0),
                                             particle_at(5, 0)};
  for (const int column : {0, 1, 2, 6, 7, 8}) {
    particles.push_back(particle_at(column, 0));
  }
  return box_with(particles);
}

TEST(VoidModel, MovesOneOfThreeGrainsIntoAVoid) {
  VoidModel model(notch());
  EXPECT_EQ(model.step().moved_count, 1);
  EXPECT_TRUE(model.occupancy().is_taken(model.state().lattice.index({4, 0})));
}

TEST(VoidModel, TakesTheGrainStraightAboveWhereItAloneHasAWeight) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    grains::State state = notch();
    state.seed = seed;
    VoidModel straight(state, {.straight_weight = 1, .sieve_factors = {}});
    straight.step();
    EXPECT_EQ(straight.state().particles[0].site(), (lattice::Site{4, 0}));
    VoidModel beside(state, {.straight_weight = 0, .sieve_factors = {}});
    beside.step();
    EXPECT_EQ(beside.state().particles[0].site(), (lattice::Site{4, 1}));
  }
}

TEST(VoidModel, NeverTakesAGrainOfWeightZero) {
  grains::State state = notch();
  for (grains::Particle& particle : state.particles) {
    particle.kind = 1;
  }
  VoidModel model(state, {.straight_weight = 1.0 / 3, .sieve_factors = {1, 0}});
  EXPECT_TRUE(model.step().settled);
  EXPECT_EQ(model.state().particles, state.particles);
}

TEST(VoidModel, RefusesWhatItCannotRun) {
  grains::State large = box_with({});
  large.kinds[1].shape = lattice::Shape::hexagon(1);
  EXPECT_THROW(VoidModel{large}, std::invalid_argument);

  grains::State moving = box_with({});
  moving.walls = testing::good_state().walls;
  moving.walls[0].sites = {{1, 1}};
  EXPECT_THROW(VoidModel{moving}, std::invalid_argument);

  const grains::State right = box_with({});
  EXPECT_THROW(VoidModel(right, {.straight_weight = 1.5, .sieve_factors = {}}),
               std::invalid_argument);
  EXPECT_THROW(VoidModel(right, {.straight_weight = 0.5, .sieve_factors = {1, -1}}),
               std::invalid_argument);
  EXPECT_THROW(VoidModel(right, {.straight_weight = 0.5, .sieve_factors = {1}}),
               std::invalid_argument);
  EXPECT_THROW(VoidModel(right, {}, {.threads = 0}), std::invalid_argument);
}

}  // namespace
}  // namespace clca::voids::void_model_test
