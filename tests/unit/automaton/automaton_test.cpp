#include "clca/automaton/automaton.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <set>
#include <stdexcept>

#include "support/states.hpp"

namespace clca::automaton::automaton_test {
namespace {

using grains::kRest;
using grains::Move;
using grains::Occupancy;
using grains::Outlet;
using grains::Particle;
using grains::Source;
using grains::State;
using lattice::Direction;
using lattice::Shape;
using testing::empty_state;
using testing::particle_at;
using testing::settle;

TEST(Automaton, ALoneParticleFallsOneSpacingAStepAndRestsOnTheFloor) {
  State state = empty_state(9, 30);
  state.kinds = {{Shape::hexagon(1), 0}};
  state.particles = {particle_at(4, 20)};
  Automaton automaton(state);
  for (int step = 1; step <= 19; ++step) {
    EXPECT_EQ(automaton.step().moved_count, 1U);
    EXPECT_EQ(automaton.state().particles[0].site(), (lattice::Site{4, 20 - step}));
  }
  EXPECT_TRUE(automaton.step().settled);
}

TEST(Automaton, AParticleOnASiteRollsToTheOnlyFreeSide) {
  State state = empty_state(9, 9);
  state.kinds = {{Shape::hexagon(0), 0}};
  state.walls = {{.sites = {{4, 2}, {3, 2}}, .present = true}};  // below and below left
  state.particles = {particle_at(4, 3)};
  Automaton automaton(state);
  automaton.step();
  EXPECT_EQ(automaton.state().particles[0].previous, static_cast<Move>(Direction::down_right));
}

TEST(Automaton, FullInertiaKeepsTheSlopeInEmptyAirAndNoneFallsStraight) {
  for (const double inertia : {0.0, 1.0}) {
    State state = empty_state(41, 60);
    state.kinds = {{Shape::hexagon(0), 0}};
    state.particles = {particle_at(4, 50)};
    state.particles[0].previous = static_cast<Move>(Direction::down_right);
    Automaton automaton(state, {.inertia = inertia});
    for (int step = 0; step < 20; ++step) {
      automaton.step();
    }
    EXPECT_EQ(automaton.state().particles[0].column, inertia == 1.0 ? 24 : 4);
  }
}

TEST(Automaton, InertiaIsTheProbabilityToKeepTheSlope) {
  // 4,000 particles that just moved down_right with all directions free; 1,000 boxes of 4 columns.
  State state = empty_state(16'000, 8);
  state.kinds = {{Shape::hexagon(0), 0}};
  for (int i = 0; i < 4000; ++i) {
    state.particles.push_back(particle_at(4 * i + 1, 4));
    state.particles.back().previous = static_cast<Move>(Direction::down_right);
  }
  Automaton automaton(state, {.inertia = 0.7});
  automaton.step();
  int kept = 0;
  for (const Particle& particle : automaton.state().particles) {
    kept += particle.previous == static_cast<Move>(Direction::down_right) ? 1 : 0;
  }
  EXPECT_NEAR(kept, 2800, 4 * std::sqrt(4000 * 0.7 * 0.3));
}

TEST(Automaton, ScatterTakesAllFreeDirectionsAlike) {
  State state = empty_state(16'000, 8);
  state.kinds = {{Shape::hexagon(0), 0}};
  for (int i = 0; i < 3000; ++i) {
    state.particles.push_back(particle_at(4 * i + 1, 4));
  }
  Automaton automaton(state, {.scatter = 1});
  automaton.step();
  std::map<Move, int> counts;
  for (const Particle& particle : automaton.state().particles) {
    ++counts[particle.previous];
  }
  EXPECT_EQ(counts.size(), 3U);
  for (const auto& [move, count] : counts) {
    EXPECT_NEAR(count, 1000, 4 * std::sqrt(3000 * 2.0 / 9.0));
  }
}

TEST(Automaton, OfTwoMoversToOneSiteTheClassDecidesAndElseADraw) {
  // A falls straight into the site that B, just rolled, wants too.
  const auto winner = [](std::array<UpdateClass, 3> order, std::uint64_t seed) {
    State state = empty_state(9, 12, seed);
    state.kinds = {{Shape::hexagon(0), 0}};
    // Column 4 is even: its lower left neighbour of row r is (3, r - 1).
    state.particles = {particle_at(3, 6), particle_at(4, 6)};
    state.particles[0].previous = static_cast<Move>(Direction::down);
    state.particles[1].previous = static_cast<Move>(Direction::down_left);
    state.walls = {{.sites = {{4, 5}, {5, 5}}, .present = true}};
    Automaton automaton(state, {.inertia = 1, .update_priority = order});
    automaton.step();
    EXPECT_NE(automaton.state().particles[0].previous == kRest,
              automaton.state().particles[1].previous == kRest);
    return automaton.state().particles[0].previous == kRest ? 1 : 0;
  };
  using enum UpdateClass;
  std::set<int> winners;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    EXPECT_EQ(winner({gravity, rest, inertia}, seed), 0);
    winners.insert(winner({rest, inertia, gravity}, seed));  // both keep their direction
  }
  EXPECT_THAT(winners, ::testing::ElementsAre(0, 1));
}

TEST(Automaton, AMixedCollapseEqualsTheReferenceForBothKindsOfTies) {
  for (const TieBreaking ties : {TieBreaking::particle, TieBreaking::direction}) {
    const Rules rules = {.inertia = 0.9, .ties = ties};
    const State start = testing::mixed_automaton(80, 60, 50).state();
    Automaton reference(start, rules, {.use_reference = true});
    Automaton automaton(start, rules);
    Automaton threaded(start, rules, {.threads = 2, .min_parallel_particles = 1});
    for (int step = 0; step < 120; ++step) {
      reference.step();
      automaton.step();
      threaded.step();
      ASSERT_EQ(automaton.state(), reference.state()) << "step " << step;
      ASSERT_EQ(threaded.state(), reference.state()) << "step " << step;
    }
  }
}

TEST(Automaton, TheTwoKindsOfTiesAreNotTheSamePhysics) {
  const State state = testing::mixed_automaton(80, 60, 60).state();
  Automaton by_particle(state);
  Automaton by_direction(state, {.ties = TieBreaking::direction});
  settle(by_particle);
  settle(by_direction);
  EXPECT_NE(by_particle.state().particles, by_direction.state().particles);
}

TEST(Automaton, AllSixCandidatesNeverComeToRest) {
  Automaton automaton(testing::mixed_automaton(40, 40, 10).state(),
                      {.candidates = CandidateDirections::all});
  for (int step = 0; step < 500; ++step) {
    EXPECT_FALSE(automaton.step().settled);
  }
}

TEST(Automaton, GravityMayPointAlongAnyDirection) {
  for (const Direction gravity : lattice::kDirections) {
    State state = empty_state(40, 40);
    state.kinds = {{Shape::hexagon(1), 0}};
    state.particles = {particle_at(20, 20)};
    Automaton automaton(state, {.gravity = gravity});
    automaton.step();
    EXPECT_EQ(automaton.state().particles[0].previous, static_cast<Move>(gravity));
    settle(automaton);
  }
}

TEST(Automaton, PeriodicBoxesLetParticlesAcrossTheSeam) {
  State state = empty_state(10, 30);
  state.lattice = lattice::Lattice(10, 30, true);
  state.kinds = {{Shape::hexagon(1), 0}};
  state.particles = {particle_at(8, 25)};
  state.particles[0].previous = static_cast<Move>(Direction::down_right);
  Automaton automaton(state, {.inertia = 1});
  for (int step = 0; step < 15; ++step) {
    automaton.step();
    EXPECT_EQ(Occupancy(automaton.state()), automaton.occupancy());
  }
  EXPECT_EQ(automaton.state().particles[0].column, 23);  // runs on; wrapped it stands in column 3
}

TEST(Walls, WhatTwoWallsCoverStaysUntilBothAreGone) {
  State state = empty_state(9, 12);
  state.kinds = {{Shape::hexagon(0), 0}};
  std::vector<lattice::Site> shelf;
  for (int column = 0; column < 9; ++column) {
    shelf.push_back({column, 5});
  }
  state.walls = {{.sites = shelf}, {.sites = shelf}};
  state.particles = {particle_at(4, 6)};
  Automaton automaton(state);
  EXPECT_TRUE(automaton.step().settled);
  automaton.remove_wall(0);
  EXPECT_TRUE(automaton.step().settled);
  automaton.remove_wall(1);
  EXPECT_FALSE(automaton.step().settled);
}

TEST(Occupancy, RefusesOverlapsAndParticlesOutsideTheBox) {
  State state = empty_state(20, 20);
  state.kinds = {{Shape::hexagon(1), 0}};
  state.particles = {particle_at(5, 5), particle_at(6, 5)};
  EXPECT_THROW(Automaton{state}, std::invalid_argument);
  state.particles = {particle_at(0, 5)};
  EXPECT_THROW(Automaton{state}, std::invalid_argument);
  state.particles = {};
  state.walls = {{.sites = {{25, 3}}}};
  EXPECT_THROW(Automaton{state}, std::invalid_argument);
}

TEST(Hash, ChangesWithEveryFieldThatARunChanges) {
  State state = testing::mixed_automaton(40, 40, 5).state();
  state.walls = {{.sites = {}}};
  state.sources = {Source{}};
  state.outlets = {Outlet{}};
  std::set<std::uint64_t> hashes = {hash(state)};
  const auto changed = [&](auto change) {
    State copy = state;
    change(copy);
    hashes.insert(hash(copy));
  };
  changed([](State& s) { ++s.seed; });
  changed([](State& s) { ++s.step; });
  changed([](State& s) { ++s.particles[3].column; });
  changed([](State& s) { ++s.particles[3].row; });
  changed([](State& s) { s.particles[3].previous = 2; });
  changed([](State& s) { s.particles[3].present = false; });
  changed([](State& s) { s.walls[0].present = false; });
  changed([](State& s) { s.sources[0].credit = 1; });
  changed([](State& s) { s.sources[0].emitted = 1; });
  changed([](State& s) { s.sources[0].open = true; });
  changed([](State& s) { s.outlets[0].particles = 1; });
  changed([](State& s) { s.outlets[0].sites = 1; });
  changed([](State& s) { std::swap(s.particles[1], s.particles[2]); });
  EXPECT_EQ(hashes.size(), 14U);
}

}  // namespace
}  // namespace clca::automaton::automaton_test
