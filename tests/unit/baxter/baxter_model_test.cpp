#include "clca/baxter/baxter_model.hpp"

#include <gtest/gtest.h>

#include <set>
#include <stdexcept>

#include "clca/measure/mixing.hpp"
#include "support/states.hpp"

namespace clca::baxter::baxter_model_test {
namespace {

using lattice::Direction;
using testing::particle_at;

grains::State box_with(const std::vector<grains::Particle>& particles, std::uint64_t seed = 1) {
  grains::State state = testing::empty_state(9, 6, seed);
  state.kinds = kinds_along_axes(0);
  state.particles = particles;
  for (const grains::Particle& particle : particles) {
    state.origins.push_back(particle.site());
  }
  return state;
}

TEST(BaxterModel, LetsALoneGrainFallStraightToTheFloorWithItsAxis) {
  BaxterModel model(box_with({particle_at(4, 3, 2)}));
  for (int row = 2; row >= 0; --row) {
    EXPECT_EQ(model.step().moved_count, 1);
    EXPECT_EQ(model.state().particles[0].site(), (lattice::Site{4, row}));
    EXPECT_EQ(model.state().particles[0].previous, static_cast<grains::Move>(Direction::down));
  }
  EXPECT_FALSE(model.step().settled);  // it has come to rest in this step
  EXPECT_EQ(model.state().particles[0].previous, grains::kRest);
  EXPECT_TRUE(model.step().settled);
  EXPECT_EQ(axis_of(model.state().particles[0]), 2);
}

TEST(BaxterModel, AGrainAtRestTurnsToTheAxisOfItsNeighbours) {
  const auto turned = [](double like_axes) {
    BaxterModel model(box_with({particle_at(3, 0, 1), particle_at(4, 0, 0), particle_at(5, 0, 1)}),
                      {.like_axes_factor = like_axes});
    model.step();
    return axis_of(model.state().particles[1]);
  };
  EXPECT_EQ(turned(0.01), 1);
  EXPECT_EQ(turned(1), 0);
}

TEST(BaxterModel, TwoThatTurnToEachOtherNeverSettle) {
  grains::State state = box_with({particle_at(4, 0, 1), particle_at(4, 1, 2)});
  state.walls = {{.sites = {{3, 0}, {5, 0}}}};
  BaxterModel model(std::move(state));
  for (int step = 0; step < 4; ++step) {
    const grains::StepReport report = model.step();
    EXPECT_EQ(report.moved_count, 0);
    EXPECT_FALSE(report.settled);
    EXPECT_EQ(axis_of(model.state().particles[0]), step % 2 == 0 ? 2 : 1);
    EXPECT_EQ(axis_of(model.state().particles[1]), step % 2 == 0 ? 1 : 2);
  }
}

TEST(BaxterModel, OneOfTwoThatWantASiteGetsItByADraw) {
  // A row on the floor but for the site in column 4: those beside it want it, at equal energies.
  std::vector<grains::Particle> particles = {particle_at(3, 0), particle_at(5, 0)};
  for (const int column : {0, 1, 2, 6, 7, 8}) {
    particles.push_back(particle_at(column, 0));
  }
  std::set<std::size_t> movers;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    BaxterModel model(box_with(particles, seed));
    EXPECT_EQ(model.step().moved_count, 1);
    movers.insert(model.state().particles[0].previous == grains::kRest ? 1 : 0);
  }
  EXPECT_EQ(movers.size(), 2);
}

TEST(BaxterModel, FallsOnlyIfThatPaysMoreThanTheVelocitiesOfItsNeighbours) {
  // Two neighbours at rest: to fall costs 0.2 for each of them, to stay 0.1 and E_G.
  const auto falls = [](double gravity) {
    grains::State state = box_with({particle_at(4, 1), particle_at(3, 1), particle_at(5, 1)});
    state.walls = {{.sites = {{3, 0}, {5, 0}}}};
    BaxterModel model(std::move(state), {.exponent = 1, .gravity = gravity, .like_axes_factor = 1});
    model.step();
    return model.state().particles[0].previous == static_cast<grains::Move>(Direction::down);
  };
  EXPECT_TRUE(falls(0.25));
  EXPECT_FALSE(falls(0.15));
}

TEST(AxisOrder, IsTheShareOfNeighboursWithOneAxis) {
  const grains::State row = box_with(
      {particle_at(0, 0, 0), particle_at(1, 0, 0), particle_at(2, 0, 1), particle_at(3, 0, 1)});
  EXPECT_DOUBLE_EQ(measure::axis_order(row).value(), 2.0 / 3);
  EXPECT_FALSE(measure::axis_order(box_with({particle_at(0, 0)})).has_value());
}

TEST(BaxterModel, RefusesWhatItCannotRun) {
  grains::State large = box_with({});
  large.kinds[1].shape = lattice::Shape::hexagon(1);
  EXPECT_THROW(BaxterModel{large}, std::invalid_argument);

  grains::State without_axes = box_with({});
  without_axes.kinds.pop_back();
  EXPECT_THROW(BaxterModel{without_axes}, std::invalid_argument);

  grains::State moving = box_with({});
  moving.walls = testing::good_state().walls;
  moving.walls[0].sites = {{1, 1}};
  EXPECT_THROW(BaxterModel{moving}, std::invalid_argument);

  const grains::State right = box_with({});
  EXPECT_THROW(BaxterModel(right, {.exponent = 7}), std::invalid_argument);
  EXPECT_THROW(BaxterModel(right, {.gravity = -1}), std::invalid_argument);
  EXPECT_THROW(BaxterModel(right, {.like_axes_factor = 1.5}), std::invalid_argument);
  EXPECT_THROW(BaxterModel(right, {}, {.threads = 0}), std::invalid_argument);
}

}  // namespace
}  // namespace clca::baxter::baxter_model_test
