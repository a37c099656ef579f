#pragma once
// Walls that move, come and go.

#include "automaton/rule/wall_push.hpp"
#include "automaton/rule/world.hpp"
#include "clca/automaton/automaton.hpp"
#include "grains/internal/wall_step.hpp"

namespace clca::automaton {

class MovingWalls {
 public:
  explicit MovingWalls(const grains::State& state) : edges_(state) {}

  /// Moves every active wall by the step that its motion asks for, if it can, in the order of their
  /// numbers.
  void advance(World& world, StepReport& report) const;
  /// Ends the step: motions that wait for rest may go on.
  static void end_step(World& world, bool particles_moved);
  /// True when no wall will move while no particle does: each has come to its end, or has tried
  /// in vain and cannot take the step that it wants next either.
  bool is_still(World& world) const;

 private:
  grains::WallEdges edges_;
};

/// See Automaton::remove_wall.
void remove_wall(World& world, std::size_t number);
/// See Automaton::insert_wall.
bool insert_wall(World& world, std::size_t number);

}  // namespace clca::automaton
