#pragma once
// Walls that move, written down as plainly as it can be.

#include "clca/grains/state.hpp"

namespace clca::testing {

struct WallTurns {
  std::size_t moved = 0;
  std::size_t stalled = 0;
};

/// Lets every active wall take its step, in the order of their numbers.
WallTurns oracle_walls(grains::State& state);

/// Ends the step for walls that wait.
void oracle_wait(grains::State& state, bool particles_moved);

}  // namespace clca::testing
