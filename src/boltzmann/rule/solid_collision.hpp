#pragma once
// The law of clca/boltzmann/scheme.hpp for equal solid spheres of mass 1 with spins as surface
// velocities w = a omega: mu = 1/2, K = 7, a^2 / I = 5/2. For many pairs, one per lane.

#include <Eigen/Core>
#include <limits>

#include "boltzmann/elementary.hpp"
#include "clca/boltzmann/scheme.hpp"

namespace clca::boltzmann {

/// a^2 / I of a solid sphere of mass 1.
inline constexpr double kInverseInertia = 2.5;
/// K = 1/mu + 2 a^2/I.
inline constexpr double kSolidCompliance = 7;

/// A: friction stops the sliding where it is at least |V_t| / (V n).
inline double friction_number(const Law& law) {
  return kSolidCompliance / 2 * law.friction * (1 + law.restitution);
}

/// Lanes are rows, so that each component is contiguous. Width 1 is one pair, computed alike.
template <int kWidth>
using Lanes = Eigen::Array<double, kWidth, 1>;
template <int kWidth>
using Vectors = Eigen::Array<double, kWidth, 3>;

template <int kWidth>
Lanes<kWidth> dot(const Vectors<kWidth>& a, const Vectors<kWidth>& b) {
  return a.col(0) * b.col(0) + a.col(1) * b.col(1) + a.col(2) * b.col(2);
}

/// |v|^2 as dot() adds it up.
template <class Derived>
double squared(const Eigen::ArrayBase<Derived>& v) {
  return v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
}

template <int kWidth>
Vectors<kWidth> cross(const Vectors<kWidth>& a, const Vectors<kWidth>& b) {
  Vectors<kWidth> result;
  for (const int x : {0, 1, 2}) {
    const int y = (x + 1) % 3;
    const int z = (x + 2) % 3;
    result.col(x) = a.col(y) * b.col(z) - a.col(z) * b.col(y);
  }
  return result;
}

/// Impulses: v1 -= impulse, v2 += impulse; w1 and w2 -= kInverseInertia * angular_impulse.
template <int kWidth>
struct ImpulsePair {
  Vectors<kWidth> impulse;          ///< P
  Vectors<kWidth> angular_impulse;  ///< (1 - R)/K n x V_t
};

/// g = v1 - v2, spins = w1 + w2, normal: unit vector from the first centre to the second.
/// Precondition: g . normal >= 0.
template <int kWidth>
ImpulsePair<kWidth> solid_collision(const Law& law, const Vectors<kWidth>& g,
                                    const Vectors<kWidth>& spins, const Vectors<kWidth>& normal) {
  const Lanes<kWidth> approach = dot(g, normal);
  const Vectors<kWidth> slip = g + cross(spins, normal) - normal.colwise() * approach;
  const Lanes<kWidth> speed = dot(slip, slip).sqrt();
  // (1 - R)/K. Without slip it only must not be NaN.
  const Lanes<kWidth> grip =
      (friction_number(law) * approach / speed.max(std::numeric_limits<double>::min()))
          .min(1 + law.roughness) /
      kSolidCompliance;
  const Lanes<kWidth> along = (1 + law.restitution) / 2 * approach;
  return {.impulse = normal.colwise() * along + slip.colwise() * grip,
          .angular_impulse = cross(normal, slip).colwise() * grip};
}

/// Line of centres with density cos(angle to g) / pi on the hemisphere about g: the direction of
/// g/|g| + s with s uniform on the sphere, drawn from two uniform numbers in (0, 1).
template <int kWidth>
Vectors<kWidth> line_of_centres(const Vectors<kWidth>& g, const Lanes<kWidth>& height,
                                const Lanes<kWidth>& azimuth) {
  const Lanes<kWidth> inverse = 1.0 / dot(g, g).sqrt();
  const Lanes<kWidth> z = 2.0 * height - 1.0;
  const Lanes<kWidth> radius = (1.0 - z * z).sqrt();
  const auto [cosine, sine] = cosine_and_sine<Lanes<kWidth>>(azimuth);
  Vectors<kWidth> sum = g.colwise() * inverse;
  sum.col(0) += radius * cosine;
  sum.col(1) += radius * sine;
  sum.col(2) += z;
  const Lanes<kWidth> length = dot(sum, sum).sqrt().max(std::numeric_limits<double>::min());
  const Lanes<kWidth> scale = 1.0 / length;
  return sum.colwise() * scale;
}

/// Pairs that collide.
template <int kWidth>
struct Collisions {
  Eigen::Array<double, kWidth, 6> first;  // velocity and spin
  Eigen::Array<double, kWidth, 6> second;
  Lanes<kWidth> first_speed;
  Lanes<kWidth> second_speed;
  Lanes<kWidth> height;  // of the line of centres, see there
  Lanes<kWidth> azimuth;

  /// Replaces the motions by those after the collisions, and sets the speeds.
  void compute(const Law& law) {
    Vectors<kWidth> velocity1 = first.template leftCols<3>();
    Vectors<kWidth> velocity2 = second.template leftCols<3>();
    const Vectors<kWidth> g = velocity1 - velocity2;
    const Vectors<kWidth> spins = first.template rightCols<3>() + second.template rightCols<3>();
    const auto [impulse, angular_impulse] =
        solid_collision(law, g, spins, line_of_centres(g, height, azimuth));
    velocity1 -= impulse;
    velocity2 += impulse;
    first << velocity1, first.template rightCols<3>() - kInverseInertia * angular_impulse;
    second << velocity2, second.template rightCols<3>() - kInverseInertia * angular_impulse;
    first_speed = dot(velocity1, velocity1).sqrt();
    second_speed = dot(velocity2, velocity2).sqrt();
  }
};

}  // namespace clca::boltzmann
