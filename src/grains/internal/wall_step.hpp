#pragma once
// One step of a wall and the particles that it pushes.

#include <array>
#include <optional>
#include <vector>

#include "clca/grains/state.hpp"
#include "grains/internal/footprint.hpp"
#include "grains/internal/occupancy_table.hpp"

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
  /// Sites that a step enters and leaves, at the initial position of the wall.
  struct Edge {
    std::vector<lattice::Site> lead;
    std::vector<lattice::Site> trail;
  };
  /// Along the motion and against it.
  using Edges = std::array<Edge, 2>;

  std::vector<Edges> edges_;  // by wall; empty for those without motion
};

/// The particles that must move together with a wall.
class PushedCluster {
 public:
  PushedCluster(const State& state, const OccupancyTable& occupancy,
                const FootprintTable& footprints, const WallStep& step)
      : state_(state),
        occupancy_(occupancy),
        footprints_(footprints),
        step_(step),
        included_(state.particles.size(), false) {}

  /// Returns false if the border or another wall blocks the step. `overlaps(id)`: whether a
  /// particle shares sites with others, which then move too.
  template <class Overlaps>
  bool gather(Overlaps overlaps) {
    for (const std::size_t place : step_.enters) {
      add_owner_of(place);
    }
    for (std::size_t i = 0; i < ids_.size() && !blocked_; ++i) {
      const Particle& particle = state_.particles[ids_[i]];
      const Footprint& footprint = footprints_.of(particle);
      add_owners(particle, footprint.lead[index_of(step_.direction)]);
      if (overlaps(ids_[i])) {
        add_owners(particle, footprint.body);
      }
    }
    return !blocked_;
  }

  const std::vector<std::uint32_t>& ids() const { return ids_; }

 private:
  void add_owners(const Particle& particle, const std::vector<lattice::Offset>& offsets);
  void add_owner_of(std::size_t place);
  void add(Owner owner);

  const State& state_;
  const OccupancyTable& occupancy_;
  const FootprintTable& footprints_;
  const WallStep& step_;
  std::vector<bool> included_;
  std::vector<std::uint32_t> ids_;
  bool blocked_ = false;
};

}  // namespace clca::grains
