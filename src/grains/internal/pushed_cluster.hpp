#pragma once
// The particles that a wall pushes.

#include <vector>

#include "grains/internal/box.hpp"

namespace clca::grains {

/// The particles that must move together with a wall.
class PushedCluster {
 public:
  PushedCluster(const Box& box, const WallStep& step)
      : box_(box), step_(step), included_(box.state.particles.size(), false) {}

  /// Returns false if the border or another wall blocks the step. `overlaps(id)`: whether a
  /// particle shares sites with others, which then move too.
  template <class Overlaps>
  bool gather(Overlaps overlaps) {
    for (const std::size_t index : step_.enters) {
      add_owners(index);
    }
    for (std::size_t i = 0; i < ids_.size() && !blocked_; ++i) {
      const Particle& particle = box_.state.particles[ids_[i]];
      const Footprint& footprint = box_.footprints.of(particle);
      add_owners(particle, footprint.lead[index_of(step_.direction)]);
      if (overlaps(ids_[i])) {
        add_owners(particle, footprint.body);
      }
    }
    return !blocked_;
  }

  const std::vector<std::uint32_t>& ids() const { return ids_; }

 private:
  void add_owners(const Particle& particle, const std::vector<lattice::Offset>& offsets) {
    box_.for_each_index(particle, offsets, [this](std::size_t index) { add_owners(index); });
  }
  void add_owners(std::size_t index);
  void add(Owner owner);

  const Box& box_;
  const WallStep& step_;
  std::vector<bool> included_;
  std::vector<std::uint32_t> ids_;
  bool blocked_ = false;
};

}  // namespace clca::grains
