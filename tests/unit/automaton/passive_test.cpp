// The passive rule in situations small enough to follow by hand.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/overlaps.hpp"
#include "support/wall_bench.hpp"

namespace clca::automaton::passive_test {
namespace {

using grains::Drive;
using grains::kRest;
using grains::Move;
using grains::Particle;
using grains::PassiveRule;
using grains::Push;
using grains::State;
using grains::Wall;
using grains::wall_code;
using lattice::Direction;
using lattice::Shape;
using lattice::Site;
using testing::driven_wall;
using testing::empty_state;
using ::testing::IsEmpty;
using testing::particle_at;
using testing::whole_row;

constexpr Move kDown = static_cast<Move>(Direction::down);
constexpr Rules kUpwards = {.gravity = Direction::up};

/// Hexagons of radius 1 under a plate through the whole box that comes down; they float upwards.
State under_a_plate(int columns, int plate_row, std::vector<Particle> particles) {
  State state = empty_state(columns, 30);
  state.kinds = {{Shape::hexagon(1), 0}};
  state.particles = std::move(particles);
  state.walls = {driven_wall(whole_row(state, plate_row), Direction::down, PassiveRule::overlap)};
  return state;
}

TEST(PassiveRule, AParticleUnderAPlateGoesDownWithIt) {
  Automaton automaton(under_a_plate(9, 20, {particle_at(4, 18)}), kUpwards);
  for (int step = 1; step <= 10; ++step) {
    automaton.step();
    EXPECT_EQ(automaton.state().walls[0].travel.offset, step);
    EXPECT_EQ(automaton.state().particles[0].site(), (Site{4, 18 - step}));
    EXPECT_EQ(automaton.state().particles[0].previous, kDown);
    EXPECT_THAT(automaton.state().pushes, IsEmpty());
  }
}

TEST(PassiveRule, BetweenTwoPlatesThatMeetAParticleStaysAndThePlatesStall) {
  State state = under_a_plate(9, 12, {particle_at(4, 8)});
  state.walls.push_back(driven_wall(whole_row(state, 2), Direction::up, PassiveRule::overlap));
  Automaton automaton(state, kUpwards);
  for (int step = 0; step < 40; ++step) {
    automaton.step();
    ASSERT_EQ(testing::complaint(automaton.state()), "");
  }
  EXPECT_GT(automaton.state().walls[0].travel.stalls, 20U);
  EXPECT_GT(automaton.state().walls[1].travel.stalls, 20U);
  const Site before = automaton.state().particles[0].site();
  automaton.step();
  EXPECT_EQ(automaton.state().particles[0].site(), before);
  EXPECT_EQ(automaton.state().particles[0].previous, kRest);
}

TEST(PassiveRule, BetweenTwoStampsAParticleSlipsOutSideways) {
  State state = under_a_plate(21, 0, {particle_at(11, 9)});
  state.walls = {driven_wall({{10, 13}}, Direction::down, PassiveRule::overlap, 8),
                 driven_wall({{10, 4}}, Direction::up, PassiveRule::overlap, 0)};
  Automaton automaton(state, kUpwards);
  for (int step = 0; step < 12; ++step) {
    automaton.step();
    ASSERT_EQ(testing::complaint(automaton.state()), "");
  }
  EXPECT_NE(automaton.state().particles[0].column, 11);
  EXPECT_EQ(automaton.state().walls[0].travel.stalls, 0U);
  EXPECT_THAT(automaton.state().pushes, IsEmpty());
}

// Two hexagons upright on a floor in a shaft of their width.
State shaft(int plate_row) {
  return under_a_plate(3, plate_row, {particle_at(1, 1), particle_at(1, 4)});
}

TEST(PassiveRule, AChainCarriesTheSourceAndTheDirectionOfThePush) {
  Automaton automaton(shaft(6), kUpwards);
  automaton.step();
  const std::vector<Push> pushes = {
      {.pushed = 0, .pusher = 1, .source = 0, .direction = Direction::down}};
  EXPECT_EQ(automaton.state().pushes, pushes);
  EXPECT_EQ(automaton.state().particles[0].site(), (Site{1, 1}));
  EXPECT_EQ(automaton.state().particles[1].site(), (Site{1, 3}));
}

TEST(PassiveRule, NobodyIsPushedDeeperThanOneMoveAndThePlateStalls) {
  Automaton automaton(shaft(7), kUpwards);
  for (int step = 0; step < 20; ++step) {
    automaton.step();
    EXPECT_EQ(testing::complaint(automaton.state()), "");
  }
  EXPECT_EQ(automaton.state().particles[0].site(), (Site{1, 1}));
  EXPECT_EQ(automaton.state().particles[1].site(), (Site{1, 3}));
  EXPECT_GT(automaton.state().walls[0].travel.stalls, 10U);
}

/// A slanted row of `length` sites that a stamp of its form pushes onto another in a closed shaft.
State stamped_rows(int length) {
  State state = empty_state(10, 16);
  std::vector<lattice::Axial> row;
  std::vector<Site> stamp;
  std::vector<Site> shut;
  for (int column = 0; column < 10; ++column) {
    const Site lowest = Site{0, 4} + lattice::Axial{column, 0};
    const bool inside = column < length;
    for (int height = 0; height < 16; ++height) {
      if (!inside || height < lowest.row) {
        shut.push_back({column, height});
      }
    }
    if (inside) {
      row.push_back({column, 0});
      stamp.push_back({column, lowest.row + 2});
    }
  }
  state.kinds = {{Shape(row), 0}};
  state.particles = {particle_at(0, 4), particle_at(0, 5)};
  state.walls = {driven_wall(stamp, Direction::down, PassiveRule::overlap, 1), {.sites = shut}};
  return state;
}

TEST(PassiveRule, AParticleBearsTwoOverlappedSitesAtLeastAndElseThirtyPercent) {
  for (const int length : {1, 2, 3, 6, 7}) {
    Automaton automaton(stamped_rows(length), kUpwards);
    automaton.step();
    const bool borne = length <= 2;  // they would share all their sites
    EXPECT_EQ(automaton.state().particles[1].site(), (Site{0, borne ? 4 : 5})) << length;
    EXPECT_EQ(automaton.state().pushes.size(), 1U) << length;
    EXPECT_EQ(automaton.state().pushes[0].pusher, borne ? 1 : wall_code(0)) << length;
  }
}

TEST(Retreat, APusherGoesBackFromWhomItPushedOnceThePlateIsGone) {
  Automaton automaton(shaft(7), kUpwards);
  for (int step = 0; step < 5; ++step) {
    automaton.step();
  }
  ASSERT_EQ(automaton.state().pushes.size(), 2U);  // the plate, too, has come onto the upper one
  automaton.remove_wall(0);
  ASSERT_EQ(automaton.state().pushes.size(), 1U);
  automaton.step();
  EXPECT_THAT(automaton.state().pushes, IsEmpty());
  EXPECT_EQ(automaton.state().particles[0].site(), (Site{1, 1}));
  EXPECT_EQ(automaton.state().particles[1].site(), (Site{1, 4}));
}

TEST(Retreat, GoesBackAgainstGravityAndRestsWhereTheWayIsBarred) {
  for (const bool barred : {false, true}) {
    State state = shaft(12);
    state.particles[1] = particle_at(1, 3);
    state.pushes = {{.pushed = 0, .pusher = 1, .source = 0, .direction = Direction::down}};
    if (barred) {
      state.walls.push_back({.sites = whole_row(state, 5)});
    }
    Automaton automaton(state);
    automaton.set_wall_moving(0, false);
    automaton.step();
    EXPECT_EQ(automaton.state().particles[1].site(), (Site{1, barred ? 3 : 4}));
    EXPECT_EQ(automaton.state().pushes.size(), barred ? 1U : 0U);
  }
}

TEST(Settled, IsToldOfAJamAndTheJamStays) {
  Automaton automaton(shaft(7), kUpwards);
  testing::settle(automaton);
  const State jam = automaton.state();
  for (int step = 0; step < 5; ++step) {
    EXPECT_TRUE(automaton.step().settled);
  }
  EXPECT_EQ(automaton.state().particles, jam.particles);
  EXPECT_EQ(automaton.state().pushes, jam.pushes);
  EXPECT_EQ(automaton.state().walls[0].travel.stalls, jam.walls[0].travel.stalls + 5);
}

TEST(Settled, IsToldOfTwoStalledWallsThatNeverTryInTheSameStep) {
  State state = empty_state(12, 12);
  for (const int column : {2, 8}) {
    Wall wall = driven_wall({{column, 10}}, Direction::up, PassiveRule::rigid);
    wall.motion->program = Drive{.period = 2, .distance = 5};
    wall.travel.clock = column == 2 ? 0 : 1;
    state.walls.push_back(wall);
    state.walls.push_back({.sites = {{column, 11}}});
  }
  Automaton automaton(state, kUpwards);
  int steps = 0;
  while (steps < 50 && !automaton.step().settled) {
    ++steps;
  }
  EXPECT_LT(steps, 5);
  EXPECT_TRUE(automaton.step().settled);
}

}  // namespace
}  // namespace clca::automaton::passive_test
