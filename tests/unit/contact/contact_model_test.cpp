// Grains in a box: what steps and stages do with them.

#include "clca/contact/contact_model.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "contact/rule/step.hpp"
#include "support/states.hpp"

namespace clca::contact::contact_model_test {
namespace {

using lattice::Shape;
using testing::empty_state;
using testing::particle_at;

constexpr Parameters kParameters = {.fall_height = 40};

/// Both ways to take steps.
class ContactModelTest : public ::testing::TestWithParam<bool> {
 protected:
  static ContactModel model(grains::State grains, const Parameters& parameters = kParameters) {
    State state{.grains = std::move(grains)};
    state.velocities.resize(state.grains.particles.size());
    state.remainders.resize(state.grains.particles.size());
    return model(std::move(state), parameters);
  }
  static ContactModel model(State state, const Parameters& parameters = kParameters) {
    return ContactModel(std::move(state), parameters, {.use_reference = GetParam()});
  }
};

grains::State box(std::vector<grains::Particle> particles = {}, int columns = 40, int rows = 60) {
  grains::State state = empty_state(columns, rows);
  state.kinds = {{Shape::hexagon(1), 0}, {Shape::hexagon(2), 1}};
  for (const grains::Particle& particle : particles) {
    state.origins.push_back(particle.site());
  }
  state.particles = std::move(particles);
  return state;
}

/// Steps until nothing moves any more. Returns how many.
int settle(ContactModel& model, int most = 20'000) {
  int steps = 1;
  while (!model.step().settled && steps < most) {
    ++steps;
  }
  EXPECT_LT(steps, most);
  return steps;
}

TEST_P(ContactModelTest, AGrainOnTheFloorRestsAtOnce) {
  ContactModel one = model(box({particle_at(10, 1)}));
  for (int step = 0; step < 100; ++step) {
    EXPECT_EQ(one.step().moved_count, 0U);
    EXPECT_EQ(one.state().velocities[0], Velocity<std::int32_t>());
  }
  EXPECT_EQ(one.state().remainders[0], Vector());
  EXPECT_EQ(one.grains().particles[0].site(), (lattice::Site{10, 1}));
}

TEST_P(ContactModelTest, WhatRestsIsSettledAfterSixtySteps) {
  ContactModel one = model(box({particle_at(10, 1)}));
  EXPECT_EQ(settle(one), 60);
  EXPECT_EQ(one.state().quiet_steps, 60U);
}

// A grain that is faster than that and free would have moved by a site.
TEST(GrainsRest, IfNoneHasMovedForLongEvenIfSomeAreFaster) {
  State held{.grains = box({particle_at(10, 1)})};
  const std::int32_t slow = kSpacing / 1000;
  held.unmoved_steps = 2999;
  EXPECT_FALSE(grains_are_at_rest(held, slow));
  held.unmoved_steps = 3001;
  EXPECT_TRUE(grains_are_at_rest(held, slow));
  EXPECT_FALSE(grains_are_at_rest(held, 0)) << "without gravity nothing says how long that is";
  reset_rest_counters(held);
  EXPECT_FALSE(grains_are_at_rest(held, slow));
}

TEST_P(ContactModelTest, AGrainThatBouncesComesToRest) {
  for (const double restitution : {0.5, 0.9}) {
    Parameters parameters = kParameters;
    parameters.restitution = restitution;
    ContactModel one = model(box({particle_at(10, 20)}), parameters);
    EXPECT_LT(settle(one), 5000) << restitution;
  }
}

TEST_P(ContactModelTest, AGrainThrownUpFollowsAParabolaWithinASite) {
  State state{.grains = box({particle_at(60, 5)}, 300, 100)};
  constexpr double kUp = 0.45;
  constexpr double kRight = 0.3;
  state.velocities = {
      {static_cast<std::int32_t>(kRight * kSpacing), static_cast<std::int32_t>(kUp * kSpacing), 0}};
  state.remainders.resize(1);
  const double acceleration = gravity(kParameters);
  ContactModel one = model(std::move(state));
  const Eigen::Vector2d start = lattice::position(lattice::Site{60, 5});
  const int flight = static_cast<int>(2 * kUp / acceleration) - 5;
  double highest = 0;
  for (int n = 1; n <= flight; ++n) {
    one.step();
    const Eigen::Vector2d now = grains::centre(one.grains(), one.grains().particles[0]) - start;
    ASSERT_NEAR(now.x(), kRight * n, 1) << n;
    ASSERT_NEAR(now.y(), kUp * n - acceleration * n * (n + 1) / 2, 1) << n;
    highest = std::max(highest, now.y());
  }
  EXPECT_NEAR(highest, kUp * kUp / (2 * acceleration), 1);
}

TEST_P(ContactModelTest, ImpulsesOnTheFloorCarryTheWeightOfAllGrains) {
  for (const Rolling rolling : {Rolling::none, Rolling::resistance, Rolling::free}) {
    grains::State grains = box();
    grains.lattice = lattice::Lattice(40, 200, true);
    Parameters parameters = kParameters;
    parameters.rolling = rolling;
    ContactModel bed = model(std::move(grains), parameters);
    const std::vector<std::size_t> counts = {60, 30};
    ASSERT_TRUE(bed.fill({0, 0, 1e3, 1e3}, counts).complete);
    settle(bed);
    // Means over some steps: rest is a balance of small motions.
    constexpr int kSteps = 50;
    double sum = 0;
    for (int step = 0; step < kSteps; ++step) {
      bed.step();
      for (const Contact& contact : bed.state().contacts) {
        sum += contact.other == kFloor ? contact.impulse.normal : 0;
      }
    }
    const double sites = 60 * 7 + 30 * 19;
    const double carried =
        sum / kSteps / kSpacing / gravity(parameters) * mass_unit(bed.grains().kinds);
    EXPECT_NEAR(carried, sites, 0.01 * sites) << static_cast<int>(rolling);
  }
}

TEST_P(ContactModelTest, AColumnOfGrainsIsHeldByTheLowestOne) {
  grains::State grains = box();
  for (int i = 0; i < 8; ++i) {
    grains.particles.push_back(particle_at(20, 1 + 3 * i));
    grains.origins.push_back({20, 1 + 3 * i});
  }
  ContactModel column = model(std::move(grains));
  for (int step = 0; step < 200; ++step) {
    column.step();
  }
  for (const Contact& contact : column.state().contacts) {
    const double above = 8 - contact.upper;
    const double carried = contact.impulse.normal / (kSpacing * gravity(kParameters)) *
                           mass_unit(column.grains().kinds);
    EXPECT_NEAR(carried, 7 * above, 0.01 * 7 * 8);
  }
}

TEST_P(ContactModelTest, AFillPlacesGrainsAtRestWithoutOverlap) {
  ContactModel filled = model(box());
  const std::vector<std::size_t> counts = {20, 10};
  EXPECT_TRUE(filled.fill({0, 0, 1e3, 1e3}, counts).complete);
  const State& state = filled.state();
  EXPECT_EQ(state.velocities, std::vector<Velocity<std::int32_t>>(30));
  EXPECT_EQ(state.remainders, std::vector<Vector>(30));
  EXPECT_EQ(grains::Occupancy(state.grains), filled.occupancy());
}

TEST_P(ContactModelTest, ADepositedBedHardlyMoves) {
  ContactModel bed = model(box());
  const std::vector<std::size_t> counts = {30, 10};
  ASSERT_TRUE(bed.fill({0, 0, 1e3, 1e3}, counts, true).complete);
  const double before = energy(bed.state(), gravity(kParameters)).potential;
  settle(bed);
  EXPECT_LE(energy(bed.state(), gravity(kParameters)).potential, before * 1.005);
}

TEST_P(ContactModelTest, AWallHoldsGrainsUntilItIsRemoved) {
  grains::State grains = box({particle_at(10, 22)});
  std::vector<lattice::Site> shelf;
  for (int column = 0; column < 40; ++column) {
    shelf.push_back({column, 20});
  }
  grains.walls = {{.sites = shelf}};
  ContactModel one = model(std::move(grains));
  settle(one);
  EXPECT_EQ(one.grains().particles[0].row, 22);
  one.remove_wall(0);
  EXPECT_FALSE(one.grains().walls[0].present);
  EXPECT_TRUE(one.state().changed);
  EXPECT_FALSE(one.step().settled);
  settle(one);
  EXPECT_EQ(one.grains().particles[0].row, 1);
  EXPECT_TRUE(one.insert_wall(0));
  EXPECT_EQ(grains::Occupancy(one.grains()), one.occupancy());
}

TEST_P(ContactModelTest, AWallIsNotInsertedWhereAGrainStands) {
  grains::State grains = box({particle_at(10, 1)});
  grains.walls = {{.sites = {{10, 2}}, .present = false}};
  ContactModel one = model(std::move(grains));
  EXPECT_FALSE(one.insert_wall(0));
  EXPECT_FALSE(one.grains().walls[0].present);
  EXPECT_NO_THROW(one.step());
}

TEST_P(ContactModelTest, WallsThatStayAsTheyAreChangeNothing) {
  grains::State grains = box({particle_at(10, 1), particle_at(20, 9)});
  grains.walls = {{.sites = {{10, 2}}, .present = false}, {.sites = {{30, 30}}}};
  ContactModel one = model(std::move(grains));
  for (int step = 0; step < 5; ++step) {
    one.step();
  }
  const State before = one.state();
  one.remove_wall(0);
  EXPECT_TRUE(one.insert_wall(1));
  EXPECT_FALSE(one.insert_wall(0)) << "a grain is in its way";
  EXPECT_EQ(one.state(), before);
}

// Which wall a grain touches must not depend on the order in which walls came.
TEST_P(ContactModelTest, AWallThatComesBackOwnsOfSharedSitesWhatItOwnedBefore) {
  grains::State grains = box();
  grains.walls = {{.sites = {{10, 10}, {11, 10}}}, {.sites = {{11, 10}, {12, 10}}}};
  ContactModel walls = model(std::move(grains));
  for (const std::size_t wall : {0U, 1U}) {
    walls.remove_wall(wall);
    EXPECT_EQ(grains::Occupancy(walls.grains()), walls.occupancy());
    EXPECT_TRUE(walls.insert_wall(wall));
    EXPECT_EQ(grains::Occupancy(walls.grains()), walls.occupancy());
  }
}

TEST_P(ContactModelTest, ASourceEmitsItsCountAndTheBedSettlesOnlyThen) {
  grains::State grains = box();
  grains.sources = {{.sites = {{20, 50}}, .weights = {1, 0}, .rate = 1U << 25U, .max_emitted = 3}};
  ContactModel spout = model(std::move(grains));
  EXPECT_EQ(spout.step().emitted_count, 0U);
  spout.set_source_open(0, true);
  std::size_t emitted = 0;
  grains::StepReport report;
  do {
    report = spout.step();
    emitted += report.emitted_count;
    EXPECT_EQ(spout.state().velocities.size(), emitted);
  } while (!report.settled);
  EXPECT_EQ(emitted, 3U);
  for (const grains::Particle& grain : spout.grains().particles) {
    EXPECT_LT(grain.row, 10) << "a grain still falls";
  }
}

TEST_P(ContactModelTest, AnOutletCountsAndTakesAwayWhatLiesInside) {
  grains::State grains = box({particle_at(10, 30), particle_at(30, 1)});
  grains.outlets = {{.region = {0, 0, 20, 10}}};
  ContactModel drain = model(std::move(grains));
  std::size_t removed = 0;
  for (int step = 0; step < 400; ++step) {
    removed += drain.step().removed_count;
  }
  EXPECT_EQ(removed, 1U);
  EXPECT_FALSE(drain.grains().particles[0].present);
  EXPECT_TRUE(drain.grains().particles[1].present);
  EXPECT_EQ(drain.grains().outlets[0].particles, 1U);
  EXPECT_EQ(drain.grains().outlets[0].sites, 7U);
  EXPECT_EQ(drain.state().velocities[0], Velocity<std::int32_t>());
  EXPECT_EQ(grains::Occupancy(drain.grains()), drain.occupancy());
}

TEST_P(ContactModelTest, WhatIsFilledIntoAnOutletIsGoneAtOnce) {
  grains::State grains = box();
  grains.outlets = {{.region = {0, 0, 1e3, 30}}};
  ContactModel drain = model(std::move(grains));
  const std::vector<std::size_t> counts = {20, 10};
  ASSERT_TRUE(drain.fill({0, 0, 1e3, 30}, counts).complete);
  drain.step();
  EXPECT_EQ(grains::present_count(drain.grains()) + drain.grains().outlets[0].particles, 30U);
  EXPECT_GT(drain.grains().outlets[0].particles, 20U);
  EXPECT_EQ(drain.state().velocities.size(), 30U);
  EXPECT_EQ(grains::Occupancy(drain.grains()), drain.occupancy());
}

TEST_P(ContactModelTest, AReportCountsEachGrainThatMovedOnce) {
  State state{.grains = box({particle_at(10, 1), particle_at(20, 30)})};
  state.velocities.resize(2);
  state.velocities[1].x = kSpacing / 2;  // sometimes two moves in a step
  state.remainders.resize(2);
  ContactModel two = model(std::move(state));
  std::size_t moves = 0;
  for (int step = 0; step < 400; ++step) {
    const lattice::Site before = two.grains().particles[1].site();
    const grains::StepReport report = two.step();
    const bool moved = two.grains().particles[1].site() != before;
    EXPECT_EQ(report.moved_count, moved ? 1U : 0U);
    moves += report.moved_count;
  }
  EXPECT_GE(moves, 20U);
}

TEST_P(ContactModelTest, OriginsAreWhereGrainsWereWhenTheyWereMarked) {
  ContactModel one = model(box({particle_at(10, 30)}));
  settle(one);
  EXPECT_EQ(one.grains().origins[0], (lattice::Site{10, 30}));
  one.reset_origins();
  EXPECT_EQ(one.grains().origins[0], one.grains().particles[0].site());
}

TEST_P(ContactModelTest, WhatIsNotThereIsRefusedAndItGoesOn) {
  ContactModel one = model(box({particle_at(10, 30)}));
  const std::vector<std::size_t> one_count = {1};
  const std::vector<std::size_t> counts = {1, 1};
  EXPECT_THROW(one.fill({0, 0, 30, 30}, one_count), std::invalid_argument);
  EXPECT_THROW(one.fill({0, 0, std::nan(""), 30}, counts, true), std::invalid_argument);
  EXPECT_THROW(one.remove_wall(0), std::out_of_range);
  EXPECT_THROW(one.insert_wall(0), std::out_of_range);
  EXPECT_THROW(one.set_source_open(0, true), std::out_of_range);
  EXPECT_NO_THROW(one.step());
}

TEST_P(ContactModelTest, AWallHasTheFrictionThatItIsGiven) {
  // A grain slides on a smooth shelf and is stopped by a rough one.
  for (const double friction : {0.0, 1.0}) {
    State state{.grains = box({particle_at(10, 1)}, 400, 20)};
    state.grains.walls = {{.sites = {}}};
    for (int column = 0; column < 400; ++column) {
      state.grains.walls[0].sites.push_back({column, 5});
    }
    state.grains.particles[0].row = 7;
    state.velocities = {{kSpacing / 4, 0, 0}};
    state.remainders.resize(1);
    Parameters parameters = kParameters;
    parameters.rolling = Rolling::none;
    parameters.friction_by_wall = {friction};
    ContactModel one(std::move(state), parameters, {.use_reference = GetParam()});
    for (int step = 0; step < 400; ++step) {
      one.step();
    }
    if (friction == 0) {
      EXPECT_EQ(one.state().velocities[0].x, kSpacing / 4);
    } else {
      EXPECT_NEAR(one.state().velocities[0].x, 0, 1);
    }
  }
}

std::vector<lattice::Site> block(lattice::Site first, int columns, int rows) {
  std::vector<lattice::Site> sites;
  for (int column = 0; column < columns; ++column) {
    for (int row = 0; row < rows; ++row) {
      sites.push_back({first.column + column, first.row + row});
    }
  }
  return sites;
}

// With a normal for each wall it was thrown sideways at the seam.
TEST_P(ContactModelTest, AGrainFallsPastTheSeamOfTwoFlushWalls) {
  State state{.grains = box({particle_at(11, 100)}, 40, 120)};
  state.grains.walls = {{.sites = block({0, 0}, 10, 60)}, {.sites = block({0, 60}, 10, 60)}};
  state.velocities.resize(1);
  state.remainders.resize(1);
  state.wall_remainders.resize(2);
  Parameters parameters = kParameters;
  parameters.friction = parameters.wall_friction = 0;
  ContactModel one = model(std::move(state), parameters);
  while (one.grains().particles[0].row > 5) {
    one.step();
    ASSERT_EQ(one.state().velocities[0].x, 0) << one.grains().particles[0].row;
  }
}

TEST_P(ContactModelTest, AGrainSlidesOverTheSeamOfTwoFlushWalls) {
  for (const int seam : {97, 98, 99, 100}) {
    State state{.grains = box({particle_at(20, 4)}, 200, 20)};
    state.grains.walls = {{.sites = block({0, 0}, seam, 3)},
                          {.sites = block({seam, 0}, 200 - seam, 3)}};
    state.velocities = {{kSpacing / 4, 0, 0}};
    state.remainders.resize(1);
    state.wall_remainders.resize(2);
    Parameters parameters = kParameters;
    parameters.friction = parameters.wall_friction = 0;
    ContactModel one = model(std::move(state), parameters);
    while (one.grains().particles[0].column < 180) {
      one.step();
      ASSERT_EQ(one.state().velocities[0].x, kSpacing / 4) << seam;
      ASSERT_EQ(one.state().velocities[0].y, 0) << seam;
    }
  }
}

TEST_P(ContactModelTest, VelocitiesAskedForAloneAreThoseOfTheState) {
  grains::State grains = box({particle_at(10, 20), particle_at(20, 30)});
  grains.outlets = {{.region = {0, 0, 20, 10}}};
  ContactModel one = model(std::move(grains));
  EXPECT_EQ(one.state_with_old_contacts().velocities, one.state().velocities);
  for (int step = 0; step < 400; ++step) {
    one.step();
    const std::vector<Velocity<>> alone = one.state_with_old_contacts().velocities;
    EXPECT_EQ(alone, one.state().velocities);
    EXPECT_EQ(alone[0] == Velocity<>(), !one.grains().particles[0].present);
  }
  EXPECT_EQ(one.grains().outlets[0].particles, 2U);
}

TEST_P(ContactModelTest, ACornerOfTwoWallsStaysACorner) {
  State state{.grains = box({particle_at(11, 4)}, 40, 40)};
  state.grains.walls = {{.sites = block({0, 0}, 40, 3)}, {.sites = block({0, 3}, 10, 30)}};
  state.velocities = {{-kSpacing / 4, 0, 0}};
  state.remainders.resize(1);
  state.wall_remainders.resize(2);
  Parameters parameters = kParameters;
  parameters.restitution = 0;
  ContactModel one = model(std::move(state), parameters);
  one.step();
  EXPECT_EQ(one.state().contacts.size(), 2U);
  for (int step = 0; step < 100; ++step) {
    one.step();
  }
  EXPECT_EQ(one.grains().particles[0].site(), (lattice::Site{11, 4}));
}

INSTANTIATE_TEST_SUITE_P(Engines, ContactModelTest, ::testing::Bool(),
                         [](const auto& engine) { return engine.param ? "Reference" : "Fast"; });

}  // namespace
}  // namespace clca::contact::contact_model_test
