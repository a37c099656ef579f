// Grains that hit others: rebounds, energies, impulses.

#include <gtest/gtest.h>

#include <algorithm>

#include "clca/contact/contact_model.hpp"
#include "contact/internal/mass_unit.hpp"
#include "support/states.hpp"

namespace clca::contact::impacts_test {
namespace {

using testing::particle_at;

/// Both ways to take steps.
class ImpactsTest : public ::testing::TestWithParam<bool> {
 protected:
  static ContactModel model(std::vector<grains::Particle> particles, double restitution,
                            int columns = 40) {
    State state{.grains = testing::empty_state(columns, 120)};
    state.grains.kinds = {{lattice::Shape::hexagon(1), 0}};
    state.grains.particles = std::move(particles);
    for (const grains::Particle& particle : state.grains.particles) {
      state.grains.origins.push_back(particle.site());
    }
    state.velocities.resize(state.grains.particles.size());
    state.remainders.resize(state.grains.particles.size());
    return ContactModel(std::move(state), parameters(restitution), {.reference = GetParam()});
  }
  static Parameters parameters(double restitution) {
    return {.friction = 0,
            .wall_friction = 0,
            .rolling = Rolling::none,
            .restitution = restitution,
            .fall_height = 100};
  }
};

double vertical(const ContactModel& model, std::size_t id) {
  return static_cast<double>(model.state().velocities[id].y) / kSpacing;
}

bool has_impact(const ContactModel& model) {
  return std::any_of(model.state().contacts.begin(), model.state().contacts.end(),
                     [](const Contact& contact) { return contact.impact.normal > 0; });
}

// The momentum goes through those at rest to the floor and back, in the one step of the impact.
TEST_P(ImpactsTest, AGrainReboundsFromOthersThatRestOnTheFloor) {
  for (const double restitution : {0.5, 0.9}) {
    for (const int below : {1, 2, 7}) {
      std::vector<grains::Particle> grains = {particle_at(20, 90)};
      for (int i = 0; i < below; ++i) {
        grains.push_back(particle_at(20, 1 + 3 * i));
      }
      ContactModel column = model(grains, restitution);
      double before = 0;
      double now = 0;
      for (int step = 0; step < 2000 && now <= 0; ++step) {
        before = std::min(before, now);
        column.step();
        now = vertical(column, 0);
      }
      EXPECT_LT(before, -0.3);
      // That takes many sweeps: 32 give 0.70 of 0.9 with seven below.
      EXPECT_NEAR(now / -before, restitution, 0.04) << below << " below";
    }
  }
}

TEST_P(ImpactsTest, EnergyNeverRisesByMoreThanAStepOfFallingMayChangeIt) {
  // One of them touches a side.
  ContactModel two = model({particle_at(1, 60), particle_at(3, 20)}, 0.99, 8);
  const double gravity = contact::gravity(parameters(0.99));
  double before = energy(two.state(), gravity).sum();
  const double first = before;
  for (int step = 0; step < 1000; ++step) {
    two.step();
    const double now = energy(two.state(), gravity).sum();
    EXPECT_LE(now, before + 0.5) << step;
    before = now;
  }
  EXPECT_GT(before, 0.8 * first) << "seven impacts of 0.99";
}

TEST_P(ImpactsTest, AllImpulsesOfTheFloorTogetherCarryTheWeight) {
  ContactModel two = model({particle_at(20, 90), particle_at(20, 1)}, 0.7);
  double sum = 0;
  int steps = 0;
  bool hit = false;
  for (bool settled = false; !settled && steps < 5000; ++steps) {
    settled = two.step().settled;
    for (const Contact& contact : two.state().contacts) {
      sum += contact.other == kFloor ? contact.impulse.normal + contact.impact.normal : 0;
    }
    hit = hit || has_impact(two);
  }
  EXPECT_TRUE(hit);
  EXPECT_FALSE(has_impact(two)) << "it is of the last step alone";
  const double weight = 14 * contact::gravity(parameters(0.7)) * kSpacing;
  EXPECT_NEAR(sum * mass_unit(two.grains().kinds) / (weight * steps), 1, 0.01);
}

TEST_P(ImpactsTest, ThoseAmongMoreThanEightGrainsAreLeftToTheSweeps) {
  std::vector<grains::Particle> grains = {particle_at(20, 90)};
  for (int i = 0; i < 8; ++i) {
    grains.push_back(particle_at(20, 1 + 3 * i));
  }
  ContactModel column = model(grains, 0.9);
  while (vertical(column, 0) <= 0) {
    ASSERT_LT(column.grains().step, 2000U);
    column.step();
    EXPECT_FALSE(has_impact(column));
  }
}

TEST_P(ImpactsTest, WhatClosesSlowlyBringsNone) {
  ContactModel one = model({particle_at(20, 1), particle_at(20, 5)}, 0.9);
  for (int step = 0; step < 200; ++step) {
    one.step();
    EXPECT_FALSE(has_impact(one));
  }
}

INSTANTIATE_TEST_SUITE_P(Engines, ImpactsTest, ::testing::Bool(),
                         [](const auto& engine) { return engine.param ? "Reference" : "Fast"; });

}  // namespace
}  // namespace clca::contact::impacts_test
