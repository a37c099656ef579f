#pragma once
// Walls that move.

#include "automaton/rule/world.hpp"

namespace clca::automaton {

/// How many walls wanted to move in a step: those that did, and those that could not.
struct WallMoves {
  std::size_t moved = 0;
  std::size_t stalled = 0;
};

/// Moves every active wall by the step that its motion asks for, if it can, in the order of their
/// numbers.
WallMoves advance_walls(World& world);

/// True when no wall will move while no particle does: each has come to its end, or has tried in
/// vain and cannot take the step that it wants next either.
bool walls_are_still(World& world);

/// Ends the step: motions that wait for rest may go on.
void end_step_of_walls(World& world, bool particles_moved);

}  // namespace clca::automaton
