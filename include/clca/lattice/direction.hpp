#pragma once
// The six directions of the triangular lattice, one axis vertical (Sakaguchi et al. 2001, Fig. 2).

#include <array>
#include <compare>
#include <cstdint>

#include "clca/reflection/reflection.hpp"

namespace clca::lattice {

/// Clockwise from straight up. The sloping directions are 30 degrees from the horizontal.
enum class Direction : std::uint8_t { up, up_right, down_right, down, down_left, up_left };

inline constexpr int kDirectionCount = 6;
inline constexpr std::array<Direction, kDirectionCount> kDirections = {
    Direction::up,   Direction::up_right,  Direction::down_right,
    Direction::down, Direction::down_left, Direction::up_left};

constexpr std::size_t index_of(Direction direction) {
  return static_cast<std::size_t>(direction);
}

/// `direction` turned clockwise by `sixths` times 60 degrees (negative: anticlockwise).
constexpr Direction rotated(Direction direction, int sixths) {
  const int turned = (static_cast<int>(direction) + sixths) % kDirectionCount;
  return static_cast<Direction>(turned < 0 ? turned + kDirectionCount : turned);
}

constexpr Direction opposite(Direction direction) {
  return rotated(direction, 3);
}

/// The angle between two directions in units of 60 degrees: 0 to 3.
constexpr int sixths_between(Direction one, Direction other) {
  const int apart =
      (static_cast<int>(one) - static_cast<int>(other) + kDirectionCount) % kDirectionCount;
  return apart <= kDirectionCount / 2 ? apart : kDirectionCount - apart;
}

/// A lattice vector in axial coordinates: x steps up_right and q steps up.
struct Axial {
  int x = 0;
  int q = 0;

  constexpr auto operator<=>(const Axial&) const = default;
  constexpr Axial operator+(Axial other) const { return {x + other.x, q + other.q}; }
  constexpr Axial operator-(Axial other) const { return {x - other.x, q - other.q}; }
  CLCA_FIELDS(x, q);
};

/// One step in `direction`.
constexpr Axial unit(Direction direction) {
  constexpr std::array<Axial, kDirectionCount> kUnits = {
      {{0, 1}, {1, 0}, {1, -1}, {0, -1}, {-1, 0}, {-1, 1}}};
  return kUnits[index_of(direction)];
}

/// `vector` turned clockwise by 60 degrees.
constexpr Axial rotated_clockwise(Axial vector) {
  return {vector.x + vector.q, -vector.x};
}

/// Smallest number of unit steps that add up to `vector`.
constexpr int length_in_steps(Axial vector) {
  const auto absolute = [](int value) { return value < 0 ? -value : value; };
  return (absolute(vector.x) + absolute(vector.q) + absolute(vector.x + vector.q)) / 2;
}

}  // namespace clca::lattice
