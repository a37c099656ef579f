#pragma once
// How far grains have come beyond their sites.

#include <array>

#include "clca/contact/state.hpp"
#include "contact/rule/numbers.hpp"

namespace clca::contact {

/// Of a direction of the lattice: unit_vector(unit(direction)).
inline const UnitVector& unit_of(lattice::Direction direction) {
  constexpr std::int32_t kHalf = 1 << (kUnitBits - 1);
  constexpr std::int32_t kColumn = 929'887'697;  // half the root of 3
  static constexpr std::array<UnitVector, lattice::kDirectionCount> kUnits = {{{0, 2 * kHalf},
                                                                               {kColumn, kHalf},
                                                                               {kColumn, -kHalf},
                                                                               {0, -2 * kHalf},
                                                                               {-kColumn, -kHalf},
                                                                               {-kColumn, kHalf}}};
  return kUnits[lattice::index_of(direction)];
}

/// Adds a velocity to a remainder. Of a grain at rest, that is one that touches something and whose
/// speed is at most `slow`, the remainder is forgotten instead, bit by bit. Returns whether it is
/// at rest.
inline bool advance(Vector& remainder, const Velocity<std::int32_t>& velocity, bool touches,
                    std::int32_t slow) {
  constexpr std::int32_t kForgotten = 16;  // a sixteenth in each step
  const bool rests = touches && squared({velocity.x, velocity.y}) <= product(slow, slow);
  const auto next = [&](std::int32_t place, std::int32_t by) {
    return rests ? place - place / kForgotten : clamped(place + by, -kFarthest, kFarthest);
  };
  remainder = {next(remainder.x, velocity.x), next(remainder.y, velocity.y)};
  return rests;
}

/// Whether a grain with this remainder is to move by a site.
inline bool wants(const Vector& remainder, lattice::Direction direction) {
  return along(remainder, unit_of(direction)) > kSpacing / 2;
}

/// Takes a distance along a direction from a remainder.
inline void take(Vector& remainder, std::int32_t distance, lattice::Direction direction) {
  const UnitVector& unit = unit_of(direction);
  remainder.x -= rounded(product(distance, unit.x), kUnitBits);
  remainder.y -= rounded(product(distance, unit.y), kUnitBits);
}

/// Of a grain that has been pushed by a site: it is at most half a site behind where it stands.
inline void keep_up(Vector& remainder, lattice::Direction direction) {
  const std::int32_t room = along(remainder, unit_of(direction)) + kSpacing / 2;
  if (room < 0) {
    take(remainder, room, direction);
  }
}

/// Cuts the remainder of a grain that has no room: at 3/4 of a site dense flow would keep its
/// velocity and lose its way.
inline void cut(Vector& remainder) {
  constexpr std::int32_t kMost = 2 * kSpacing;
  for (const lattice::Direction direction : lattice::kDirections) {
    const std::int32_t excess = along(remainder, unit_of(direction)) - kMost;
    if (excess > 0) {
      take(remainder, excess, direction);
    }
  }
}

}  // namespace clca::contact
