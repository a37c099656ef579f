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
  std::uint64_t lead_sites = 0;
  std::uint64_t changed_sites = 0;  ///< lead and trail: what the move changes
  std::uint64_t wake_sites = 0;     ///< WindowedFootprint::wake_sites
};

/// Index offsets of one site that a move enters and one that it vacates.
struct Exchange {
  std::int32_t entered = 0;
  std::int32_t vacated = 0;
};

/// Exchanges per group. Shorter groups repeat an exchange, so that the loop has a fixed length:
/// discs of radius 1 need three, discs of radius 2 five.
inline constexpr std::size_t kExchangesPerGroup = 5;
using ExchangeGroup = std::array<Exchange, kExchangesPerGroup>;

/// A footprint, and the same sites as masks of windows.
struct WindowedFootprint : grains::Footprint {
  explicit WindowedFootprint(const grains::Footprint& plain) : Footprint(plain) {}

  PerDirection<ExchangeGroup> exchanges;  ///< lead and trail, away from a periodic boundary
  /// Sites whose owners may become free to move once the particle has moved in that direction,
  /// relative to its old position.
  PerDirection<lattice::IndexOffset> wake_sites;
  // Lead, trail and wake sites as masks of windows: one window if that is enough.
  bool fits_one_window = false;
  lattice::Site lower_left;   ///< site of the lower left window, from the reference site
  lattice::Site upper_right;  ///< site of the upper right window, likewise
  lattice::Site corner_from(lattice::Site reference) const {
    return {reference.column + lower_left.column, reference.row + lower_left.row};
  }
  std::array<MoveWindow, lattice::kDirectionCount> move_windows;  ///< if fits_one_window
  PerDirection<WindowMask> lead_masks;
  PerDirection<WindowMask> changed_masks;  ///< of lead and trail
};

/// The footprints of all kinds, for reference columns of either parity.
class WindowedFootprints {
 public:
  /// `candidates`: own directions of particles; they determine WindowedFootprint::wake_sites.
  WindowedFootprints(const grains::State& state, std::span<const lattice::Direction> candidates);

  const WindowedFootprint& footprint(std::uint16_t kind, int column) const {
    return table_[2U * kind + static_cast<unsigned>(column & 1)];
  }
  /// All kinds, for both parities.
  std::span<const WindowedFootprint> all() const { return table_; }

 private:
  std::vector<WindowedFootprint> table_;
};

}  // namespace clca::automaton
