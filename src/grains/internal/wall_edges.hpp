#pragma once
// The sites that walls enter and leave in a step.

#include <array>
#include <vector>

#include "clca/grains/state.hpp"

namespace clca::grains {

/// A step of a wall: the indices that it enters and leaves.
struct WallStep {
  std::size_t wall = 0;
  lattice::Direction direction = lattice::Direction::up;
  std::vector<std::size_t> enters;
  std::vector<std::size_t> leaves;
};

/// The boundary sites of moving walls.
class WallEdges {
 public:
  explicit WallEdges(const State& state);

  /// `desired`: +1 along the motion of the wall, -1 against it.
  WallStep step_of(const State& state, std::size_t number, int desired) const;

 private:
  /// Sites of a wall at its initial position that have none of it ahead: along the motion and
  /// against it.
  using Edges = std::array<std::vector<lattice::Site>, 2>;

  std::vector<Edges> edges_;  // by wall; empty for those without motion
};

}  // namespace clca::grains
