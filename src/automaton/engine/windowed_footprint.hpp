#pragma once
// The sites that the moves of each kind of particle test and change, for many sites at once.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "grains/internal/box.hpp"

namespace clca::automaton {

/// Sites of a window (see grains::Bitboard) whose lower left corner is at this offset from the
/// reference site.
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
  std::uint64_t wake = 0;     ///< WindowedFootprint::wake
};

/// Index offsets of one site that a move enters and one that it vacates.
struct Exchange {
  std::int32_t entered = 0;
  std::int32_t vacated = 0;
};

/// Exchanges per group. Shorter groups repeat an exchange, so that the loop has a fixed length:
/// discs of radius 1 need three, discs of radius 2 five.
inline constexpr std::size_t kExchanges = 5;
using Exchanges = std::array<Exchange, kExchanges>;

/// A footprint, and the same sites as masks of windows.
struct WindowedFootprint : grains::Footprint {
  explicit WindowedFootprint(const grains::Footprint& plain) : Footprint(plain) {}

  PerDirection<Exchanges> exchanges;  ///< lead and trail, away from a periodic boundary
  /// Sites whose owners may become free to move once the particle has moved in that direction,
  /// relative to its old position.
  PerDirection<lattice::Offset> wake;
  // Lead, trail and wake sites as masks of windows: one window for all moves if that is enough,
  // else several.
  bool one_window = false;
  lattice::Site corner;      ///< lower left site of the lower left window, from the reference site
  lattice::Site far_corner;  ///< upper right site of the upper right one, likewise
  lattice::Site corner_from(lattice::Site reference) const {
    return {reference.column + corner.column, reference.row + corner.row};
  }
  std::array<MoveWindow, lattice::kDirectionCount> windows;  ///< by direction, if one_window
  PerDirection<WindowMask> lead_masks;
  PerDirection<WindowMask> swapped_masks;  ///< of lead and trail
};

/// The footprints of all kinds, for reference columns of either parity.
class WindowedFootprints {
 public:
  /// `candidates`: directions in which particles move by themselves; determines
  /// WindowedFootprint::wake.
  WindowedFootprints(const grains::State& state, std::span<const lattice::Direction> candidates);

  const WindowedFootprint& of(std::uint16_t kind, int column) const {
    return table_[2U * kind + static_cast<unsigned>(column & 1)];
  }
  /// All kinds, for both parities.
  std::span<const WindowedFootprint> all() const { return table_; }

 private:
  std::vector<WindowedFootprint> table_;
};

}  // namespace clca::automaton
