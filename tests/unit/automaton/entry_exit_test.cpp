// How particles come in and leave: fills, sources, outlets.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "clca/automaton/automaton.hpp"
#include "support/states.hpp"

namespace clca::automaton::entry_exit_test {
namespace {

using grains::FillResult;
using grains::Occupancy;
using grains::Particle;
using grains::State;
using lattice::Shape;
using testing::empty_state;
using testing::particle_at;
using testing::settle;

TEST(Fill, PlacesWhatWasAskedForInsideTheRegionWithIdsUpTheColumns) {
  const Automaton automaton = testing::mixed_automaton(60, 60, 40);
  const State& state = automaton.state();
  ASSERT_EQ(state.particles.size(), 80U);
  for (std::size_t id = 1; id < 80; ++id) {
    EXPECT_LT(state.particles[id - 1].site(), state.particles[id].site());
  }
  EXPECT_EQ(Occupancy(state), automaton.occupancy());
}

TEST(Fill, SaysHowManyFittedWhenTheRegionIsFull) {
  State state = empty_state(20, 20);
  state.kinds = {{Shape::hexagon(2), 0}};
  Automaton automaton(state);
  const std::vector<std::size_t> counts = {1000};
  const FillResult result = automaton.fill({0, 0, 100, 100}, counts);
  EXPECT_FALSE(result.complete);
  EXPECT_EQ(result.placed_by_species[0], automaton.state().particles.size());
  EXPECT_GE(result.placed_by_species[0], 6U);
  // Nothing more fits: a second fill places none.
  EXPECT_EQ(automaton.fill({0, 0, 100, 100}, counts).placed_by_species[0], 0U);
}

TEST(Fill, DrawsOrientationsOfASpeciesEvenly) {
  State state = empty_state(300, 300);
  for (int turn = 0; turn < 3; ++turn) {
    state.kinds.push_back({Shape::rod(0, 3).rotated(turn), 0});
  }
  Automaton automaton(state);
  const std::vector<std::size_t> counts = {3000};
  automaton.fill({0, 0, 1000, 1000}, counts);
  std::array<int, 3> kinds{};
  for (const Particle& particle : automaton.state().particles) {
    ++kinds.at(particle.kind);
  }
  for (const int count : kinds) {
    EXPECT_NEAR(count, 1000, 4 * std::sqrt(3000 * 2.0 / 9.0));
  }
}

TEST(Source, EmitsAtItsRateUntilItsCountIsReached) {
  State state = empty_state(41, 60);
  state.kinds = {{Shape::hexagon(1), 0}};
  state.sources = {{.sites = {{20, 50}}, .weights = {1}, .rate = 1ULL << 30U, .max_emitted = 6}};
  Automaton automaton(state);
  automaton.set_source_open(0, true);
  std::vector<std::uint64_t> steps;
  grains::StepReport report;
  while (!report.settled) {
    report = automaton.step();
    for (std::size_t i = 0; i < report.emitted_count; ++i) {
      steps.push_back(automaton.state().step);
    }
  }
  EXPECT_THAT(steps, ::testing::ElementsAre(4, 8, 12, 16, 20, 24));
}

TEST(Source, ABlockedSourceDoesNotKeepARunFromSettling) {
  State state = empty_state(9, 12);
  state.kinds = {{Shape::hexagon(1), 0}};
  state.sources = {
      {.sites = {{4, 4}}, .weights = {1}, .rate = 1ULL << 32U, .max_emitted = 1'000'000}};
  Automaton automaton(state);
  automaton.set_source_open(0, true);
  settle(automaton);
  EXPECT_LT(automaton.state().sources[0].emitted, 10U);
}

TEST(Outlet, CountsAndRemovesParticlesWhollyInside) {
  State state = empty_state(9, 30);
  state.kinds = {{Shape::hexagon(1), 0}};
  state.particles = {particle_at(4, 20)};
  state.outlets = {{.region = {0, 0, 10, 5}}};
  Automaton automaton(state);
  std::size_t removed = 0;
  while (removed == 0) {
    removed += automaton.step().removed_count;
  }
  EXPECT_EQ(automaton.state().particles[0].row, 3);  // its top site is at 4, below 5
  EXPECT_EQ(automaton.state().outlets[0].particles, 1U);
  EXPECT_EQ(automaton.state().outlets[0].sites, 7U);
  EXPECT_EQ(present_count(automaton.state()), 0U);
  EXPECT_EQ(Occupancy(automaton.state()), automaton.occupancy());
  EXPECT_TRUE(automaton.step().settled);
}

TEST(Outlet, RemovesWhatIsEmittedInsideItAndCannotMove) {
  State state = empty_state(9, 12);
  state.kinds = {{Shape::hexagon(1), 0}};
  state.sources = {
      {.sites = {{4, 1}}, .weights = {1}, .rate = 1ULL << 32U, .max_emitted = 1, .open = true}};
  state.outlets = {{.region = {0, 0, 10, 10}}};
  Automaton automaton(state);
  EXPECT_EQ(automaton.step().removed_count, 1U);
  EXPECT_EQ(present_count(automaton.state()), 0U);
}

TEST(Outlet, RemovesWhatLiesInItAlsoWhenNothingButAWallChanges) {
  State state = empty_state(9, 12);
  state.kinds = {{Shape::hexagon(1), 0}};
  state.particles = {particle_at(4, 1)};
  state.walls = {{.sites = {{0, 11}}}};
  state.outlets = {{.region = {0, 0, 10, 10}}};
  Automaton automaton(state);
  automaton.remove_wall(0);
  EXPECT_EQ(automaton.state().outlets[0].particles, 1U);
  EXPECT_EQ(present_count(automaton.state()), 0U);
}

TEST(Outlet, CatchesParticlesAcrossAPeriodicSeam) {
  State state = empty_state(10, 30);
  state.lattice = lattice::Lattice(10, 30, true);
  state.kinds = {{Shape::hexagon(1), 0}};
  state.particles = {particle_at(0, 20)};
  state.outlets = {{.region = {0, 0, 10, 5}}};
  Automaton automaton(state);
  settle(automaton);
  EXPECT_EQ(automaton.state().outlets[0].particles, 1U);
}

}  // namespace
}  // namespace clca::automaton::entry_exit_test
