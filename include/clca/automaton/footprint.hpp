#pragma once
// The site lists of every kind of particle, ready for use on one lattice.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "clca/automaton/state.hpp"

namespace clca::automaton {

/// Sites in a window (see SiteBits) whose lower left corner lies so far from a reference site.
struct Patch {
  std::int32_t column = 0;
  std::int32_t row = 0;
  std::uint64_t sites = 0;

  lattice::Site corner(lattice::Site reference) const {
    return {reference.column + column, reference.row + row};
  }
};

/// The sites of one kind seen from reference columns of one parity.
struct Footprint {
  template <class T>
  using PerDirection = std::array<std::vector<T>, lattice::kDirectionCount>;

  std::vector<lattice::Offset> body;
  std::array<lattice::Site, lattice::kDirectionCount> step;  ///< columns and rows of a step
  PerDirection<lattice::Offset> lead;
  PerDirection<lattice::Offset> trail;
  /// Sites whose owners may gain a free direction when the particle has moved that way (seen from
  /// where it stood before).
  PerDirection<lattice::Offset> wake;
  // The same by windows. Where one is enough for all of them, it has the same corner in all.
  PerDirection<Patch> lead_patches;
  PerDirection<Patch> swapped_patches;  ///< lead and trail: what a move changes
  PerDirection<Patch> wake_patches;
  bool one_window = false;
  Patch corner;  ///< of the first window, without sites
};

/// Directions that the rules allow: gravity first, then its neighbours clockwise and
/// anticlockwise, then the rest.
std::span<const lattice::Direction> candidate_directions(const Rules& rules);

class FootprintTable {
 public:
  explicit FootprintTable(const State& state);

  const Footprint& of(const Particle& particle) const {
    return table_[2 * particle.kind + (lattice::is_odd(particle.column) ? 1U : 0U)];
  }

 private:
  std::vector<Footprint> table_;
};

}  // namespace clca::automaton
