#include "general_law.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace clca::boltzmann {

namespace {

using Eigen::Vector3d;

/// a^2 / I.
double rotation_share(const Sphere& sphere) {
  return sphere.radius * sphere.radius / sphere.inertia;
}

/// Normal and tangential velocity of a contact.
struct Slip {
  double normal = 0;    ///< V n
  Vector3d tangential;  ///< V_t
  double braking = 0;   ///< 1 - R, from 0 to 1 + roughness
};

Slip slip_of(const Law& law, const Pair& pair, const CollisionState& contact) {
  const Vector3d slip = contact.slip(pair);
  const double normal = slip.dot(contact.normal);
  const Vector3d tangential = slip - normal * contact.normal;
  // Without sliding, the contact sticks if there is friction.
  const double speed = std::max(tangential.norm(), std::numeric_limits<double>::min());
  const double braking = std::min(1 + law.roughness, friction_number(law, pair) * normal / speed);
  return {.normal = normal, .tangential = tangential, .braking = braking};
}

}  // namespace

double Pair::reduced_mass() const {
  return first.mass * second.mass / (first.mass + second.mass);
}

double Pair::compliance() const {
  return 1 / reduced_mass() + rotation_share(first) + rotation_share(second);
}

Vector3d CollisionState::slip(const Pair& pair) const {
  const Vector3d surface = pair.first.radius * first.spin + pair.second.radius * second.spin;
  return first.velocity - second.velocity + surface.cross(normal);
}

double friction_number(const Law& law, const Pair& pair) {
  return law.friction * pair.compliance() * pair.reduced_mass() * (1 + law.restitution);
}

double tangential_ratio(const Law& law, const Pair& pair, const CollisionState& contact) {
  return 1 - slip_of(law, pair, contact).braking;
}

CollisionState collide(const Law& law, const Pair& pair, const CollisionState& contact) {
  const Slip slip = slip_of(law, pair, contact);
  const Vector3d friction = slip.braking / pair.compliance() * slip.tangential;
  const Vector3d impulse =
      pair.reduced_mass() * (1 + law.restitution) * slip.normal * contact.normal + friction;
  const Vector3d angular_impulse = contact.normal.cross(friction);
  CollisionState after = contact;
  after.first.velocity -= impulse / pair.first.mass;
  after.second.velocity += impulse / pair.second.mass;
  after.first.spin -= pair.first.radius / pair.first.inertia * angular_impulse;
  after.second.spin -= pair.second.radius / pair.second.inertia * angular_impulse;
  return after;
}

EnergyLoss energy_loss(const Law& law, const Pair& pair, const CollisionState& contact) {
  const Slip slip = slip_of(law, pair, contact);
  const double elastic = 1 - law.restitution * law.restitution;
  return {.normal = pair.reduced_mass() / 2 * elastic * slip.normal * slip.normal,
          .tangential = slip.braking * (2 - slip.braking) / (2 * pair.compliance()) *
                        slip.tangential.squaredNorm()};  // 1 - R^2
}

}  // namespace clca::boltzmann
