#pragma once
// Integer arithmetic: the same bits on every machine and compiler. Operations of the contact law
// also exist for eight contacts at once (engine/batch_avx2.cpp).

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "clca/contact/state.hpp"
#include "clca/lattice/direction.hpp"
#include "lattice/internal/require.hpp"

namespace clca::contact {

inline constexpr int kMassBits = 16;         ///< of masses in their unit, see mass_unit()
inline constexpr int kInverseMassBits = 26;  ///< of inverse masses, which are at most 8
inline constexpr int kRatioBits = 16;        ///< of coefficients of friction and restitution

/// Product of two numbers. Sums of products must fit a sign and 62 bits.
inline std::int64_t product(std::int32_t one, std::int32_t other) {
  return std::int64_t{one} * other;
}
/// The same number in every lane.
inline std::int32_t in_all_lanes(std::int32_t value, std::int32_t /*like*/) {
  return value;
}
/// value / 2^bits, rounded.
inline std::int64_t rounded64(std::int64_t value, int bits) {
  return (value + (std::int64_t{1} << (bits - 1))) >> bits;
}
/// value / 2^bits, rounded, if the result fits.
inline std::int32_t rounded(std::int64_t value, int bits) {
  return static_cast<std::int32_t>(rounded64(value, bits));
}
/// value / 2^bits, rounded; where that exceeds `most`, a power of two, some number with an absolute
/// value of at least `most`.
inline std::int32_t limited(std::int64_t value, int bits, std::int32_t most) {
  return static_cast<std::int32_t>(std::clamp<std::int64_t>(rounded64(value, bits), -most, most));
}
inline std::int32_t clamped(std::int32_t value, std::int32_t low, std::int32_t high) {
  return std::min(std::max(value, low), high);
}
inline std::int32_t clamped(std::int64_t value, std::int32_t low, std::int32_t high) {
  return static_cast<std::int32_t>(std::clamp<std::int64_t>(value, low, high));
}

/// A number in units of 2^-bits, at most 2^30 of them.
inline std::int32_t to_fixed_point(double value, int bits) {
  return static_cast<std::int32_t>(std::llround(std::min(std::ldexp(value, bits), 0x1p30)));
}

/// Unit vector along a non-zero lattice vector. One division and one square root each, which every
/// machine rounds alike.
inline UnitVector unit_vector(lattice::Axial vector) {
  const double x = vector.x;
  const double doubled_y = 2.0 * vector.q + x;
  const double squared = 3 * x * x + doubled_y * doubled_y;  // 4 times the length squared
  const auto component = [&](double square, bool negative) {
    const auto size =
        static_cast<std::int32_t>(std::llround(std::ldexp(std::sqrt(square / squared), kUnitBits)));
    return negative ? -size : size;
  };
  return {component(3 * x * x, x < 0), component(doubled_y * doubled_y, doubled_y < 0)};
}

/// unit_vector(unit(direction)).
inline const UnitVector& unit_vector(lattice::Direction direction) {
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

inline Eigen::Vector2d as_double(const UnitVector& unit) {
  return {std::ldexp(unit.x, -kUnitBits), std::ldexp(unit.y, -kUnitBits)};
}

/// Cosine of the angle between two unit vectors, in 2^-60.
inline std::int64_t cosine(const UnitVector& one, const UnitVector& other) {
  return product(one.x, other.x) + product(one.y, other.y);
}

/// Component of a vector along a unit vector.
inline std::int32_t along(const Vector& vector, const UnitVector& unit) {
  return rounded(product(vector.x, unit.x) + product(vector.y, unit.y), kUnitBits);
}

inline std::int64_t squared(const Vector& vector) {
  return product(vector.x, vector.x) + product(vector.y, vector.y);
}

}  // namespace clca::contact
