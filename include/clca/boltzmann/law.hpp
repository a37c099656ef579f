#pragma once
// The collision of two inelastic, frictional spheres.
//
// Ogawa & Kato 1982, eqs. 1 to 26, with two misprints corrected: A of (19) is eta K mu (1 +
// epsilon), and C4 of (26) has a factor 1/2.
// Here for one pair in Eigen vectors; the schemes use the vectorised boltzmann/solid_collision.hpp.

#include <Eigen/Core>

namespace clca::boltzmann {

/// How a collision changes the relative velocity at the contact point. The tangential velocity is
/// multiplied by R = max(-roughness, 1 - A (V n) / |V_t|):
/// friction slows sliding until it ends (R = 0) or, with a roughness, reverses (Walton 1993).
struct Law {
  double restitution = 1;  ///< epsilon, normal; 0 to 1
  double friction = 0;     ///< eta, of Coulomb; 0 or more, kNoSlidingLimit for none
  double roughness = 0;    ///< beta, tangential restitution; -1 (smooth) to 1 (reversed)

  bool operator==(const Law&) const = default;
};

/// Throws std::invalid_argument unless the numbers are in these ranges.
void check(const Law& law);

/// Friction without sliding: constant tangential restitution.
inline constexpr double kNoSlidingLimit = 1e300;

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
