#pragma once
// The site lists of every kind of particle, ready for use on one lattice.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "clca/grains/state.hpp"

namespace clca::grains {

/// Sites in a window (see SiteBits) whose lower left corner lies so far from a reference site.
struct Patch {
  std::int32_t column = 0;
  std::int32_t row = 0;
  std::uint64_t sites = 0;

  lattice::Site corner(lattice::Site reference) const {
    return {reference.column + column, reference.row + row};
  }
};

/// What a move looks at and changes, as sites of one window.
struct MoveWindow {
  std::uint64_t lead = 0;
  std::uint64_t swapped = 0;  ///< lead and trail: what the move changes
  std::uint64_t wake = 0;
};

/// Places, seen from that of the reference site: as many are entered as are left.
struct Exchange {
  std::int32_t entered = 0;
  std::int32_t left = 0;
};

/// Some of them twice, lest a processor guess wrong how many there are: discs of radius 1 have
/// three, those of radius 2 five.
inline constexpr std::size_t kExchanges = 5;
using Exchanges = std::array<Exchange, kExchanges>;

/// The sites of one kind seen from reference columns of one parity.
struct Footprint {
  template <class T>
  using PerDirection = std::array<std::vector<T>, lattice::kDirectionCount>;

  std::vector<lattice::Offset> body;
  PerDirection<lattice::Offset> lead;
  PerDirection<lattice::Offset> trail;
  PerDirection<Exchanges> exchanges;  ///< both, away from a seam
  /// Sites whose owners may gain a free candidate direction when the particle has moved that way
  /// (seen from where it stood before).
  PerDirection<lattice::Offset> wake;
  // The same by windows: one that is the same for all moves, where that is enough, or several.
  bool one_window = false;
  lattice::Site corner;  ///< of the one, seen from the reference site
  lattice::Site corner_from(lattice::Site reference) const {
    return {reference.column + corner.column, reference.row + corner.row};
  }
  std::array<MoveWindow, lattice::kDirectionCount> windows;
  PerDirection<Patch> lead_patches;
  PerDirection<Patch> swapped_patches;
};

class FootprintTable {
 public:
  /// `candidates`: directions in which particles move by themselves, see Footprint::wake.
  FootprintTable(const State& state, std::span<const lattice::Direction> candidates);

  const Footprint& of(const Particle& particle) const { return of(particle.kind, particle.column); }
  const Footprint& of(std::uint16_t kind, int column) const {
    return table_[2U * kind + static_cast<unsigned>(column & 1)];
  }
  /// Of all kinds, for both parities.
  std::span<const Footprint> all() const { return table_; }

 private:
  std::vector<Footprint> table_;
};

}  // namespace clca::grains
