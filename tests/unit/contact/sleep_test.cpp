// Grains that steps leave out until something disturbs them.

#include "contact/rule/sleep.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "clca/contact/contact_model.hpp"
#include "support/states.hpp"

namespace clca::contact::sleep_test {
namespace {

using lattice::Shape;
using testing::empty_state;

constexpr Parameters kParameters = {.fall_height = 40, .sleeping = true};

/// Both ways to take steps.
class SleepTest : public ::testing::TestWithParam<bool> {
 protected:
  /// Grains dropped into a box, with a wall across it at half its height.
  static ContactModel bed(std::size_t count, const Parameters& parameters = kParameters) {
    grains::State grains = empty_state(40, 80);
    grains.kinds = {{Shape::hexagon(1), 0}, {Shape::hexagon(2), 1}};
    grains.seed = 5;
    grains.walls = {{.sites = lattice::sites_in(grains.lattice, {-1, 30, 100, 31})}};
    ContactModel model({.grains = std::move(grains)}, parameters, {.reference = GetParam()});
    model.fill({0, 34, 100, 80}, std::vector<std::size_t>{count / 2, count / 2});
    return model;
  }
};

std::size_t sleepers(const ContactModel& model) {
  const Sleep& sleep = model.state().sleep;
  return static_cast<std::size_t>(std::count_if(
      sleep.rests.begin(), sleep.rests.end(), [](std::uint8_t rests) { return rests >= kAsleep; }));
}

/// Takes steps until so many grains sleep.
void run_until_asleep(ContactModel& model, std::size_t count) {
  constexpr int kMost = 20'000;
  int steps = 0;
  while (sleepers(model) < count && steps < kMost) {
    model.step();
    ++steps;
  }
  ASSERT_LT(steps, kMost);
}

TEST_P(SleepTest, ABedFallsAsleepAndStaysSo) {
  ContactModel model = bed(60);
  run_until_asleep(model, 60);
  EXPECT_TRUE(model.state().contacts.empty());
  EXPECT_GT(model.state().sleep.contacts.size(), 60U);
  const Sleep asleep = model.state().sleep;
  for (int step = 0; step < 500; ++step) {
    EXPECT_EQ(model.step().moved, 0U);
  }
  EXPECT_EQ(model.state().sleep, asleep);
  EXPECT_TRUE(model.step().settled);
}

TEST_P(SleepTest, NobodySleepsUnlessTheParametersSaySo) {
  ContactModel model = bed(20, {.fall_height = 40});
  for (int step = 0; step < 1000; ++step) {
    model.step();
  }
  EXPECT_EQ(model.state().sleep, Sleep());
}

TEST_P(SleepTest, AllWakeAndFallWhenTheirSupportLeaves) {
  ContactModel model = bed(60);
  run_until_asleep(model, 60);
  const double before = energy(model.state(), gravity(kParameters)).potential;
  model.remove_wall(0);
  EXPECT_EQ(sleepers(model), 0U);
  run_until_asleep(model, 60);
  const double sites = 30 * (7 + 19);  // of the 60 grains
  EXPECT_LT(energy(model.state(), gravity(kParameters)).potential, before - 20 * sites);
}

TEST_P(SleepTest, AVesselThatMovesWakesAll) {
  ContactModel model = bed(60);
  run_until_asleep(model, 60);
  model.set_vessel(shaken({}, 0.1, 0.001, false));
  for (int step = 0; step < 200; ++step) {
    model.step();
    EXPECT_EQ(sleepers(model), 0U);
  }
}

TEST_P(SleepTest, WhatIsDisturbedWakesAtTheNextCheck) {
  ContactModel model = bed(60);
  run_until_asleep(model, 60);
  State state = model.state();
  disturb(state.sleep, 7);
  ContactModel other(state, kParameters, {.reference = GetParam()});
  for (int step = 0; step < 8; ++step) {
    other.step();
  }
  EXPECT_LT(other.state().sleep.rests[7], kAsleep);
  EXPECT_EQ(sleepers(other), 59U) << "the impulses on the others are in balance";
  EXPECT_FALSE(other.state().contacts.empty());
}

TEST_P(SleepTest, ALoadThatIsOutOfBalanceWakes) {
  ContactModel model = bed(60);
  run_until_asleep(model, 60);
  State state = model.state();
  const auto on_wall =
      std::find_if(state.sleep.contacts.begin(), state.sleep.contacts.end(),
                   [](const Contact& contact) { return !grains::is_particle(contact.other); });
  ASSERT_NE(on_wall, state.sleep.contacts.end());
  const std::uint32_t id = on_wall->upper;
  on_wall->impulse.normal = on_wall->impulse.normal * 4 + kMaxImpulse / 64;
  ContactModel other(state, kParameters, {.reference = GetParam()});
  for (int step = 0; step < 8; ++step) {
    other.step();
  }
  EXPECT_LT(other.state().sleep.rests[id], kAsleep);
}

TEST_P(SleepTest, AParameterThatIsSwitchedOffWakesAll) {
  ContactModel model = bed(60);
  run_until_asleep(model, 60);
  const std::size_t contacts = model.state().sleep.contacts.size();
  const ContactModel other(model.state(), {.fall_height = 40}, {.reference = GetParam()});
  EXPECT_EQ(other.state().sleep, Sleep());
  EXPECT_EQ(other.state().contacts.size(), contacts);
}

INSTANTIATE_TEST_SUITE_P(Steps, SleepTest, ::testing::Bool(),
                         [](const auto& of) { return of.param ? "reference" : "engine"; });

TEST(Sleep, ADeepBedIsTheSameByReferenceAndEngine) {
  const auto model = [](bool reference) {
    grains::State grains = empty_state(40, 80);
    grains.kinds = {{Shape::hexagon(1), 0}, {Shape::hexagon(2), 1}};
    grains.sources = {{.sites = {{20, 70}},
                       .weights = {1, 1},
                       .rate = std::uint64_t{1} << 27U,
                       .count = 40,
                       .open = true}};
    return ContactModel({.grains = std::move(grains)}, kParameters, {.reference = reference});
  };
  ContactModel reference = model(true);
  ContactModel engine = model(false);
  std::size_t most = 0;
  for (int step = 0; step < 6000; ++step) {
    reference.step();
    engine.step();
    ASSERT_EQ(engine.state(), reference.state()) << step;
    most = std::max(most, sleepers(engine));
  }
  EXPECT_GT(most, 20U);
}

}  // namespace
}  // namespace clca::contact::sleep_test
