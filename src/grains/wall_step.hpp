#pragma once
// One step of one wall, and the particles that it takes along.

#include <array>
#include <optional>
#include <vector>

#include "clca/grains/footprint.hpp"
#include "clca/grains/occupancy.hpp"
#include "clca/grains/state.hpp"

namespace clca::grains {

/// A wall about to take a step: the places in memory it enters and leaves.
struct WallStep {
  std::size_t wall = 0;
  lattice::Direction direction = lattice::Direction::up;
  std::vector<std::size_t> enters;
  std::vector<std::size_t> leaves;
};

/// The outlines of walls that move.
class WallEdges {
 public:
  explicit WallEdges(const State& state);

  /// `wished`: +1 along the motion of the wall, -1 against it.
  WallStep step_of(const State& state, std::size_t number, int wished) const;

 private:
  /// Sites to enter and to leave on a step, at home.
  struct Edge {
    std::vector<lattice::Site> lead;
    std::vector<lattice::Site> trail;
  };
  /// Along the motion and against it.
  using Edges = std::array<Edge, 2>;

  std::vector<Edges> edges_;  // by wall; empty for those without motion
};

/// Particles that have to go along with a wall.
class Train {
 public:
  Train(const State& state, const Occupancy& occupancy, const FootprintTable& footprints,
        const WallStep& step)
      : state_(state),
        occupancy_(occupancy),
        footprints_(footprints),
        step_(step),
        aboard_(state.particles.size(), false) {}

  /// Returns false when the way is barred by the border or another wall. `overlaps`: whether a
  /// particle shares sites with others, which then go along.
  template <class Overlaps>
  bool gather(Overlaps overlaps) {
    for (const std::size_t place : step_.enters) {
      take(place);
    }
    for (std::size_t i = 0; i < ids_.size() && !barred_; ++i) {
      const Particle& particle = state_.particles[ids_[i]];
      const Footprint& footprint = footprints_.of(particle);
      take_all(particle, footprint.lead[index_of(step_.direction)]);
      if (overlaps(ids_[i])) {
        take_all(particle, footprint.body);
      }
    }
    return !barred_;
  }

  const std::vector<std::uint32_t>& ids() const { return ids_; }

 private:
  void take_all(const Particle& particle, const std::vector<lattice::Offset>& offsets);
  void take(std::size_t place);
  void take_owner(Owner owner);

  const State& state_;
  const Occupancy& occupancy_;
  const FootprintTable& footprints_;
  const WallStep& step_;
  std::vector<bool> aboard_;
  std::vector<std::uint32_t> ids_;
  bool barred_ = false;
};

}  // namespace clca::grains
