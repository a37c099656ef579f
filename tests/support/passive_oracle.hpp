#pragma once
// A whole step with walls that move and particles that overlap, written down as plainly as it can
// be: the oracle for the real thing.

#include "clca/automaton/rules.hpp"
#include "support/wall_oracle.hpp"

namespace clca::testing {

struct WholeStep {
  WallTurns walls;
  std::size_t moved = 0;
};

/// One step of a state without sources and outlets. Walls move, then all particles decide, then
/// those pushed have their turn one after the other, then the others.
WholeStep oracle_whole_step(grains::State& state, const automaton::Rules& rules);

}  // namespace clca::testing
