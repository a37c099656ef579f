#pragma once
// Arithmetic in whole numbers, so that every machine and compiler gives the same bits.

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "clca/contact/state.hpp"
#include "clca/lattice/direction.hpp"

namespace clca::contact {

inline constexpr int kUnitBits = 30;  ///< of components of unit vectors, and of inverse masses
inline constexpr int kMassBits = 10;
inline constexpr int kRatioBits = 16;  ///< of coefficients of friction and restitution
inline constexpr std::int64_t kLargest = std::int64_t{1} << 30;

/// Velocities, lengths and impulses stay where no product overflows.
constexpr std::int32_t narrow(std::int64_t value) {
  return static_cast<std::int32_t>(std::clamp(value, -kLargest, kLargest));
}

/// value / 2^bits, rounded.
constexpr std::int64_t scaled(std::int64_t value, int bits) {
  return (value + (std::int64_t{1} << (bits - 1))) >> bits;
}

/// A number as a multiple of 2^-bits, at most 2^30 of them.
inline std::int32_t fixed(double value, int bits) {
  return static_cast<std::int32_t>(
      std::llround(std::min(std::ldexp(value, bits), static_cast<double>(kLargest))));
}

/// Components in 2^-30.
struct UnitVector {
  std::int32_t x = 0;
  std::int32_t y = 0;

  UnitVector turned() const { return {-y, x}; }  ///< anticlockwise by a right angle
  bool operator==(const UnitVector&) const = default;
};

/// In the direction of a lattice vector that is not zero. One division and one root each, which
/// every machine rounds alike.
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

inline std::int32_t along(const Vector& vector, const UnitVector& unit) {
  return narrow(scaled(std::int64_t{vector.x} * unit.x + std::int64_t{vector.y} * unit.y,
                       kUnitBits));
}

inline Vector operator+(const Vector& one, const Vector& other) {
  return {narrow(std::int64_t{one.x} + other.x), narrow(std::int64_t{one.y} + other.y)};
}
inline Vector operator-(const Vector& one, const Vector& other) {
  return {narrow(std::int64_t{one.x} - other.x), narrow(std::int64_t{one.y} - other.y)};
}
inline Vector operator*(std::int32_t size, const UnitVector& unit) {
  return {narrow(scaled(std::int64_t{size} * unit.x, kUnitBits)),
          narrow(scaled(std::int64_t{size} * unit.y, kUnitBits))};
}

inline std::int64_t squared(const Vector& vector) {
  return std::int64_t{vector.x} * vector.x + std::int64_t{vector.y} * vector.y;
}

}  // namespace clca::contact
