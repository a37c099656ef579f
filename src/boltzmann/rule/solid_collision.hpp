#pragma once
// The law of clca/boltzmann/law.hpp for equal solid spheres of mass 1 with spins as surface
// velocities w = a omega: mu = 1/2, K = 7, a^2 / I = 5/2. One pair, or many in Eigen arrays.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>

#include "boltzmann/elementary.hpp"
#include "clca/boltzmann/law.hpp"

namespace clca::boltzmann {

/// a^2 / I of a solid sphere of mass 1.
inline constexpr double kSolidSpin = 2.5;
/// K = 1/mu + 2 a^2/I.
inline constexpr double kSolidCompliance = 7;

/// A: friction stops the sliding where it is at least |V_t| / (V n).
inline double friction_number(const Law& law) {
  return kSolidCompliance / 2 * law.friction * (1 + law.restitution);
}

/// A vector, or many vectors by component. Real is double or an Eigen array.
template <class Real>
struct Vector3 {
  Real x;
  Real y;
  Real z;
};

template <class Real>
Real dot(const Vector3<Real>& a, const Vector3<Real>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

template <class Real>
Vector3<Real> cross(const Vector3<Real>& a, const Vector3<Real>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

inline double lesser(double a, double b) {
  return std::min(a, b);
}
inline double greater(double a, double b) {
  return std::max(a, b);
}
template <class Derived>
auto lesser(const Eigen::ArrayBase<Derived>& a, double b) {
  return a.min(b);
}
template <class Derived>
auto greater(const Eigen::ArrayBase<Derived>& a, double b) {
  return a.max(b);
}

/// Changes by a collision: v1 -= push, v2 += push, and both w1 and w2 -= kSolidSpin * twist.
template <class Real>
struct ImpulsePair {
  Vector3<Real> push;   ///< P
  Vector3<Real> twist;  ///< (1 - R)/K n x V_t
};

/// g = v1 - v2, spins = w1 + w2, normal: unit vector from the first centre to the second.
/// Precondition: g . normal >= 0.
template <class Real>
ImpulsePair<Real> solid_collision(const Law& law, const Vector3<Real>& g,
                                  const Vector3<Real>& spins, const Vector3<Real>& normal) {
  using std::sqrt;
  const Real approach = dot(g, normal);
  const Vector3<Real> turning = cross(spins, normal);
  const Vector3<Real> slip = {g.x + turning.x - approach * normal.x,
                              g.y + turning.y - approach * normal.y,
                              g.z + turning.z - approach * normal.z};
  const Real speed = sqrt(dot(slip, slip));
  // (1 - R)/K. Without slip it only must not be NaN.
  const Real grip =
      lesser(friction_number(law) * approach / greater(speed, std::numeric_limits<double>::min()),
             1 + law.roughness) /
      kSolidCompliance;
  const Real along = (1 + law.restitution) / 2 * approach;
  const Vector3<Real> turned = cross(normal, slip);
  return {.push = {along * normal.x + grip * slip.x, along * normal.y + grip * slip.y,
                   along * normal.z + grip * slip.z},
          .twist = {grip * turned.x, grip * turned.y, grip * turned.z}};
}

/// Line of centres with density cos(angle to g) / pi on the hemisphere about g: the direction of
/// g/|g| + s with s uniform on the sphere, drawn from two uniform numbers in (0, 1).
template <class Real>
Vector3<Real> line_of_centres(const Vector3<Real>& g, const Real& height, const Real& azimuth) {
  using std::sqrt;
  const Real inverse = 1.0 / sqrt(dot(g, g));
  const Real z = 2.0 * height - 1.0;
  const Real radius = sqrt(1.0 - z * z);
  const auto [cosine, sine] = cosine_and_sine<Real>(azimuth);
  const Vector3<Real> sum = {g.x * inverse + radius * cosine, g.y * inverse + radius * sine,
                             g.z * inverse + z};
  const Real scale =
      1.0 / Real(greater(Real(sqrt(dot(sum, sum))), std::numeric_limits<double>::min()));
  return {sum.x * scale, sum.y * scale, sum.z * scale};
}

}  // namespace clca::boltzmann
