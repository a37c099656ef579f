#pragma once
// Walls that move, and what is in their way.

#include <array>
#include <optional>
#include <vector>

#include "automaton/wall_push.hpp"
#include "automaton/world.hpp"
#include "clca/automaton/automaton.hpp"

namespace clca::automaton {

class WallMover {
 public:
  explicit WallMover(const grains::State& state);

  /// Lets every active wall take the step it wants, if it can, in the order of their numbers.
  void advance(World& world, StepReport& report);
  /// Ends the step: what waits for rest may go on.
  static void end_step(World& world, bool particles_moved);
  /// True when every active wall has come to its end, or has tried in vain and cannot take the step
  /// that it wants next either, so that none will ever move while no particle does.
  bool is_still(World& world) const;

 private:
  /// Sites to enter and to leave on a step, at home.
  struct Edge {
    std::vector<lattice::Site> lead;
    std::vector<lattice::Site> trail;
  };
  /// Along the motion and against it.
  using Edges = std::array<Edge, 2>;

  WallStep step_of(const grains::State& state, std::size_t number, int wished) const;
  const Edge& edge(std::size_t wall, bool forward) const { return edges_[wall][forward ? 0 : 1]; }

  std::vector<Edges> edges_;  // by wall; empty for those without motion
};

}  // namespace clca::automaton
