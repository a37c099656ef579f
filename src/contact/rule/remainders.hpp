#pragma once
// Remainders: the offset of grains from their sites, less than a move.

#include <algorithm>
#include <array>

#include "clca/contact/state.hpp"
#include "contact/rule/numbers.hpp"

namespace clca::contact {

/// unit_vector(unit(direction)).
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

/// Subtracts a distance along a unit vector from a remainder.
inline void take(Vector& remainder, std::int32_t distance, const UnitVector& unit) {
  remainder.x -= rounded(product(distance, unit.x), kUnitBits);
  remainder.y -= rounded(product(distance, unit.y), kUnitBits);
}

inline void take(Vector& remainder, std::int32_t distance, lattice::Direction direction) {
  take(remainder, distance, unit_of(direction));
}

/// Adds a velocity to a remainder. If the grain is at rest (it touches something and its speed is
/// at most `slow`), the remainder decays instead, but for what is along gravity: rest lifts no
/// grain, or energy would grow. Returns whether the grain is at rest.
inline bool advance(Vector& remainder, const Velocity<std::int32_t>& velocity, bool touches,
                    std::int32_t slow, const UnitVector& gravity) {
  constexpr std::int32_t kForgotten = 16;  // a sixteenth in each step
  if (!touches || squared({velocity.x, velocity.y}) > product(slow, slow)) {
    remainder.x = clamped(remainder.x + velocity.x, -kMaxRemainder, kMaxRemainder);
    remainder.y = clamped(remainder.y + velocity.y, -kMaxRemainder, kMaxRemainder);
    return false;
  }
  Vector decaying = remainder;
  take(decaying, std::max(along(remainder, gravity), 0), gravity);
  remainder.x -= decaying.x / kForgotten;
  remainder.y -= decaying.y / kForgotten;
  return true;
}

/// Whether the remainder is large enough for a move.
inline bool is_move_due(const Vector& remainder, lattice::Direction direction) {
  return along(remainder, unit_of(direction)) > kSpacing / 2;
}

/// Updates the remainder of a pushed grain: at most half a site behind its site.
inline void follow_push(Vector& remainder, lattice::Direction direction) {
  const std::int32_t room = along(remainder, unit_of(direction)) + kSpacing / 2;
  if (room < 0) {
    take(remainder, room, direction);
  }
}

}  // namespace clca::contact
