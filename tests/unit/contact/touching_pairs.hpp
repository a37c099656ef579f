#pragma once
// Two bodies that touch, in lattice spacings and sites.

#include <cmath>
#include <optional>
#include <random>

#include "contact/rule/law.hpp"

namespace clca::contact {

using Number = std::int32_t;
using Pairing = ContactBodies<Number>;

inline Number length(double spacings) {
  return static_cast<Number>(std::lround(spacings * kSpacing));
}
inline Number ratio(double value) {
  return to_fixed_point(value, kRatioBits);
}

/// Velocities at random, components up to `most`.
inline Velocity<Number> any_velocity(std::mt19937_64& random, Number most) {
  std::uniform_int_distribution<Number> component(-most, most);
  return {component(random), component(random), component(random)};
}

/// A normal in any direction.
inline UnitVector any_normal(std::mt19937_64& random) {
  const double angle = std::uniform_real_distribution(0.0, 6.283)(random);
  const auto component = [](double value) {
    return static_cast<Number>(std::lround(std::ldexp(value, kUnitBits)));
  };
  return {component(std::cos(angle)), component(std::sin(angle))};
}

/// Coefficients of hexagons of these radii; without the second those of a wall.
inline PairCoefficients pair_of(int radius, std::optional<int> other) {
  std::vector<grains::Kind> kinds = {{lattice::Shape::hexagon(radius), 0},
                                     {lattice::Shape::hexagon(other.value_or(0)), 1}};
  return all_pair_coefficients(kinds)[other ? 1 : 2];
}

inline double sites_of(int radius) {
  return 3.0 * radius * (radius + 1) + 1;
}

}  // namespace clca::contact
