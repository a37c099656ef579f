#pragma once
// Walls that move, and what is in their way.

#include "automaton/wall_push.hpp"
#include "automaton/world.hpp"
#include "clca/automaton/automaton.hpp"
#include "grains/wall_step.hpp"

namespace clca::automaton {

class WallMover {
 public:
  explicit WallMover(const grains::State& state) : edges_(state) {}

  /// Lets every active wall take the step it wants, if it can, in the order of their numbers.
  void advance(World& world, StepReport& report);
  /// Ends the step: what waits for rest may go on.
  static void end_step(World& world, bool particles_moved);
  /// True when every active wall has come to its end, or has tried in vain and cannot take the step
  /// that it wants next either, so that none will ever move while no particle does.
  bool is_still(World& world) const;

 private:
  grains::WallEdges edges_;
};

}  // namespace clca::automaton
