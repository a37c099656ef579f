#pragma once
// Walls that move, and what is in their way.

#include <array>
#include <optional>
#include <vector>

#include "automaton/world.hpp"
#include "clca/automaton/automaton.hpp"

namespace clca::automaton {

class WallMover {
 public:
  explicit WallMover(const State& state);

  /// Lets every active wall take the step it wants, if it can, in the order of their numbers.
  void advance(World& world, StepReport& report);
  /// Ends the step: what waits for rest may go on.
  static void end_step(World& world, bool particles_moved);
  /// True when every active wall has come to its end or cannot go on, now and for good unless a
  /// particle moves: those that wanted to move in this step could not.
  bool is_still(const State& state) const;

 private:
  /// Sites to enter and to leave on a step, at home.
  struct Edge {
    std::vector<lattice::Site> lead;
    std::vector<lattice::Site> trail;
  };
  /// Along the motion and against it.
  using Edges = std::array<Edge, 2>;

  const Edge& edge(std::size_t wall, bool forward) const { return edges_[wall][forward ? 0 : 1]; }

  std::vector<Edges> edges_;  // by wall; empty for those without motion
  std::vector<bool> failed_;  // by wall: wanted to move in this step and could not
};

}  // namespace clca::automaton
