#pragma once
// How far grains have come beyond their sites.

#include <array>

#include "clca/contact/state.hpp"
#include "contact/rule/numbers.hpp"

namespace clca::contact {

/// Of a direction of the lattice.
inline const UnitVector& unit_of(lattice::Direction direction) {
  static const auto units = [] {
    std::array<UnitVector, lattice::kDirectionCount> all;
    for (const lattice::Direction one : lattice::kDirections) {
      all[lattice::index_of(one)] = unit_vector(unit(one));
    }
    return all;
  }();
  return units[lattice::index_of(direction)];
}

/// Whether the speed is at most `slow`.
inline bool is_slow(const Motion& motion, std::int32_t slow) {
  return squared(motion.velocity) <= std::int64_t{slow} * slow;
}

/// Adds the velocity to the remainder. A slow grain forgets its remainder instead, bit by bit.
/// Returns whether it is slow.
inline bool advance(Motion& motion, std::int32_t slow) {
  constexpr std::int32_t kForgotten = 16;  // a sixteenth in each step
  if (is_slow(motion, slow)) {
    motion.remainder.x -= motion.remainder.x / kForgotten;
    motion.remainder.y -= motion.remainder.y / kForgotten;
    return true;
  }
  motion.remainder = motion.remainder + motion.velocity;
  return false;
}

/// Whether a grain is to move by a site.
inline bool wants(const Motion& motion, lattice::Direction direction) {
  return along(motion.remainder, unit_of(direction)) > kSpacing / 2;
}

/// After that move.
inline void step_back(Motion& motion, lattice::Direction direction) {
  motion.remainder = motion.remainder - kSpacing * unit_of(direction);
}

/// Cuts the remainder of a grain that has no room: at 3/4 of a site dense flow would keep its
/// velocity and lose its way.
inline void cut(Motion& motion) {
  constexpr std::int32_t kMost = 2 * kSpacing;
  for (const lattice::Direction direction : lattice::kDirections) {
    const std::int32_t excess = along(motion.remainder, unit_of(direction)) - kMost;
    if (excess > 0) {
      motion.remainder = motion.remainder - excess * unit_of(direction);
    }
  }
}

}  // namespace clca::contact
