#pragma once
// What theory says of cooling gases, for tests of the simulation and of the closure.

#include <cmath>
#include <numbers>

namespace clca::testing {

/// Haff's law for smooth spheres with the second cumulant `a2`: T(t) / T(0). Time as in
/// clca/boltzmann/gas.hpp.
inline double haff_temperature(double restitution, double time, double a2 = 0) {
  const double rate = 2 * std::numbers::inv_sqrtpi / 3 * (1 - restitution * restitution) *
                      (1 + 3 * a2 / 16 + 9 * a2 * a2 / 1024);
  return 1 / ((1 + rate * time) * (1 + rate * time));
}

/// van Noije & Ernst 1998: a2 of the homogeneous cooling state of smooth spheres.
inline double cooling_a2(double restitution) {
  const double square = restitution * restitution;
  return 16 * (1 - restitution) * (1 - 2 * square) /
         (81 - 17 * restitution + 30 * square * (1 - restitution));
}

/// Steady ratio of rotational to translational temperature of solid spheres with a constant
/// tangential restitution.
inline double rough_ratio(double restitution, double roughness) {
  constexpr double kSolidInertia = 0.4;  // I / (m a^2)
  const double normal = 1 - restitution * restitution;
  const double tangential = (1 - kSolidInertia) / (1 + kSolidInertia) * (1 - roughness * roughness);
  const double stretch = (1 + kSolidInertia) / (1 + roughness);
  const double h = stretch * stretch / (2 * kSolidInertia) * (normal - tangential);
  return h + std::sqrt(1 + h * h);
}

/// (1 - eta^2) / (1 + eta^2): below it the ratio of both temperatures grows without bound.
inline double critical_restitution(double friction) {
  return (1 - friction * friction) / (1 + friction * friction);
}

}  // namespace clca::testing
