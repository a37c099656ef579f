#pragma once
// The sites that each kind of particle covers, enters and leaves, as index offsets on one lattice.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "clca/grains/state.hpp"

namespace clca::grains {

/// Sites of a window (see Bitboard) whose lower left corner is at this offset from the reference
/// site.
struct WindowMask {
  std::int32_t column = 0;
  std::int32_t row = 0;
  std::uint64_t sites = 0;

  lattice::Site corner(lattice::Site reference) const {
    return {reference.column + column, reference.row + row};
  }
};

/// The sites that a move tests and changes, if all lie in one window.
struct MoveWindow {
  std::uint64_t lead = 0;
  std::uint64_t swapped = 0;  ///< lead and trail: what the move changes
  std::uint64_t wake = 0;
};

/// Index offsets of one site that a move enters and one that it leaves.
struct Exchange {
  std::int32_t entered = 0;
  std::int32_t left = 0;
};

/// Exchanges per group. Shorter groups repeat an exchange, so that the loop has a fixed length:
/// discs of radius 1 need three, discs of radius 2 five.
inline constexpr std::size_t kExchanges = 5;
using Exchanges = std::array<Exchange, kExchanges>;

/// The sites of one kind, for reference columns of one parity.
struct Footprint {
  template <class T>
  using PerDirection = std::array<std::vector<T>, lattice::kDirectionCount>;

  std::vector<lattice::Offset> body;
  PerDirection<lattice::Offset> lead;
  PerDirection<lattice::Offset> trail;
  PerDirection<Exchanges> exchanges;  ///< lead and trail, away from a periodic boundary
  /// Sites whose owners may become free to move once the particle has moved in that direction,
  /// relative to its old position.
  PerDirection<lattice::Offset> wake;
  // The same as masks of windows: one window for all moves if that is enough, else several.
  bool one_window = false;
  lattice::Site corner;  ///< of that window, relative to the reference site
  lattice::Site corner_from(lattice::Site reference) const {
    return {reference.column + corner.column, reference.row + corner.row};
  }
  std::array<MoveWindow, lattice::kDirectionCount> windows;
  PerDirection<WindowMask> lead_masks;
  PerDirection<WindowMask> swapped_masks;
};

class FootprintTable {
 public:
  /// `candidates`: directions in which particles move by themselves; determines Footprint::wake.
  FootprintTable(const State& state, std::span<const lattice::Direction> candidates);

  const Footprint& of(const Particle& particle) const { return of(particle.kind, particle.column); }
  const Footprint& of(std::uint16_t kind, int column) const {
    return table_[2U * kind + static_cast<unsigned>(column & 1)];
  }
  /// All kinds, for both parities.
  std::span<const Footprint> all() const { return table_; }

 private:
  std::vector<Footprint> table_;
};

}  // namespace clca::grains
