#pragma once
// The collision of any two spheres, as Ogawa & Kato 1982 write it: the reference for
// boltzmann/rule/solid_collision.hpp, where they are equal and solid.
//
// Their eqs. 1 to 26, with two misprints corrected: A of (19) is eta K mu (1 + epsilon), and C4 of
// (26) has a factor 1/2.

#include <Eigen/Core>

#include "clca/boltzmann/scheme.hpp"

namespace clca::boltzmann {

/// Precondition of all functions below: radius, mass and inertia are positive.
struct Sphere {
  double radius = 1;
  double mass = 1;
  double inertia = 0.4;  ///< moment of inertia about the centre; 0.4 mass radius^2 when solid
};

struct Motion {
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
  Eigen::Vector3d spin = Eigen::Vector3d::Zero();  ///< angular velocity
};

/// Two colliding spheres.
struct Pair {
  Sphere first;
  Sphere second;

  /// m1 m2 / (m1 + m2).
  double reduced_mass() const;
  /// K = 1/mu + a1^2/I1 + a2^2/I2.
  double compliance() const;
};

/// Motions of both spheres and the direction between them.
struct CollisionState {
  Motion first;
  Motion second;
  /// Unit vector from the first centre to the second.
  Eigen::Vector3d normal = Eigen::Vector3d::UnitX();

  /// V = g + (a1 w1 + a2 w2) x n, the relative velocity at the contact point; V n > 0 on approach.
  Eigen::Vector3d slip(const Pair& pair) const;
};

/// A of eq. 19, corrected: dimensionless, depends only on mass ratios.
double friction_number(const Law& law, const Pair& pair);

/// R: 1 without friction, 0 where the contact sticks, -roughness where it rebounds.
double tangential_ratio(const Law& law, const Pair& pair, const CollisionState& contact);

/// The motions after the collision; the normal is unchanged. Precondition: slip . normal >= 0.
CollisionState collide(const Law& law, const Pair& pair, const CollisionState& contact);

/// Energy lost in a collision, eqs. 24 to 26: not negative.
struct EnergyLoss {
  double normal = 0;      ///< of the motion along the normal
  double tangential = 0;  ///< of sliding and spin

  double total() const { return normal + tangential; }
};
EnergyLoss energy_loss(const Law& law, const Pair& pair, const CollisionState& contact);

}  // namespace clca::boltzmann
