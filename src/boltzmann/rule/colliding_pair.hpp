#pragma once
// A collision with a random line of centres: one pair of equal solid spheres, or many pairs at
// once.

#include <cmath>
#include <limits>

#include "boltzmann/elementary.hpp"
#include "boltzmann/rule/solid_collision.hpp"

namespace clca::boltzmann {

/// 32 uniform bits as a number in (0, 1).
inline double open_unit32(std::uint32_t bits) {
  return (bits + 0.5) * 0x1p-32;
}

/// Line of centres with density cos(angle to g) / pi on the hemisphere about g: the direction of
/// g/|g| + s with s uniform on the sphere, drawn from two uniform numbers in (0, 1).
template <class Real>
Vector3<Real> line_of_centres(const Vector3<Real>& g, const Real& height, const Real& turn) {
  using std::sqrt;
  const Real inverse = 1.0 / sqrt(dot(g, g));
  const Real z = 2.0 * height - 1.0;
  const Real radius = sqrt(1.0 - z * z);
  const auto [cosine, sine] = cosine_and_sine<Real>(turn);
  const Vector3<Real> sum = {g.x * inverse + radius * cosine, g.y * inverse + radius * sine,
                             g.z * inverse + z};
  const Real scale =
      1.0 / Real(greater(Real(sqrt(dot(sum, sum))), std::numeric_limits<double>::min()));
  return {sum.x * scale, sum.y * scale, sum.z * scale};
}

/// Velocities and spins of two colliding particles; changed by collide().
template <class Real>
struct CollidingPair {
  Vector3<Real> velocity1;
  Vector3<Real> velocity2;
  Vector3<Real> spin1;
  Vector3<Real> spin2;
  Real height;  ///< of the line of centres, see above
  Real turn;
};

template <class Real>
void subtract(Vector3<Real>& from, const Vector3<Real>& what, double times) {
  from.x -= times * what.x;
  from.y -= times * what.y;
  from.z -= times * what.z;
}

template <class Real>
void collide(const Law& law, CollidingPair<Real>& pair) {
  const Vector3<Real> g = {pair.velocity1.x - pair.velocity2.x, pair.velocity1.y - pair.velocity2.y,
                           pair.velocity1.z - pair.velocity2.z};
  const Vector3<Real> spins = {pair.spin1.x + pair.spin2.x, pair.spin1.y + pair.spin2.y,
                               pair.spin1.z + pair.spin2.z};
  const ImpulsePair<Real> exchange =
      solid_collision<Real>(law, g, spins, line_of_centres(g, pair.height, pair.turn));
  subtract(pair.velocity1, exchange.push, 1);
  subtract(pair.velocity2, exchange.push, -1);
  subtract(pair.spin1, exchange.twist, kSolidSpin);
  subtract(pair.spin2, exchange.twist, kSolidSpin);
}

}  // namespace clca::boltzmann
