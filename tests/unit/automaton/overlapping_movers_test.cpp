// Particles that overlap and move by themselves beside others that want the same sites. Small
// hexagons are handled by windows of a bitboard, so a wrong window shows here.

#include <gtest/gtest.h>

#include <algorithm>

#include "clca/automaton/automaton.hpp"
#include "support/wall_bench.hpp"

namespace clca::automaton::overlapping_movers_test {
namespace {

using grains::State;
using lattice::Direction;

/// A plate over a bed of small and large hexagons, which it presses down by `distance` sites.
State pressed_bed(std::uint64_t seed, int distance) {
  State state{.lattice = lattice::Lattice(30, 40, false)};
  state.seed = seed;
  state.kinds = {{lattice::Shape::hexagon(1), 0}, {lattice::Shape::hexagon(2), 1}};
  Automaton bed(state, {.inertia = 0});
  bed.fill({.right = 30, .top = 40}, std::array<std::size_t, 2>{45, 20});
  while (!bed.step().settled) {
  }
  state = bed.state();
  std::vector<lattice::Site> bar;
  for (int column = 8; column < 16; ++column) {
    bar.push_back({column, 39});
  }
  state.walls = {
      testing::driven_wall(bar, Direction::down, grains::PassiveRule::overlap, distance)};
  return state;
}

bool overlaps_and_moved(const State& state, std::uint32_t id) {
  return state.particles[id].previous != grains::kRest &&
         std::any_of(state.pushes.begin(), state.pushes.end(), [&](const grains::Push& push) {
           return push.pushed == id || push.pusher == grains::as_owner(id);
         });
}

/// Steps in which a particle that overlaps has moved, in the run by the reference, until it is
/// settled or for 150 steps.
std::size_t compare_runs(const State& start) {
  Automaton reference(start, {.inertia = 0.5, .scatter = 0.5}, {.use_reference = true});
  Automaton automaton(start, {.inertia = 0.5, .scatter = 0.5});
  std::size_t moves = 0;
  bool settled = false;
  for (int step = 0; step < 150 && !settled; ++step) {
    settled = reference.step().settled;
    EXPECT_EQ(automaton.step().settled, settled) << "step " << step;
    EXPECT_EQ(automaton.state(), reference.state()) << "step " << step;
    if (::testing::Test::HasFailure()) {
      break;
    }
    for (std::uint32_t id = 0; id < start.particles.size(); ++id) {
      moves += overlaps_and_moved(automaton.state(), id) ? 1U : 0U;
    }
  }
  return moves;
}

TEST(OverlappingMovers, GoWhereTheReferenceHasThemGo) {
  std::size_t moves = 0;
  for (std::uint64_t seed = 1; seed <= 40 && !HasFailure(); ++seed) {
    for (const int distance : {24, 30, 100}) {
      SCOPED_TRACE(::testing::Message() << "seed " << seed << ", distance " << distance);
      moves += compare_runs(pressed_bed(seed, distance));
    }
  }
  EXPECT_GT(moves, 500U);  // or nothing has been tested
}

}  // namespace
}  // namespace clca::automaton::overlapping_movers_test
