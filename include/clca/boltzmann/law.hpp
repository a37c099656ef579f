#pragma once
// The collision of two inelastic, frictional spheres.
//
// Ogawa & Kato 1982, eqs. 1 to 26, with two misprints put right: A of (19) is eta K mu (1 +
// epsilon), and C4 of (26) has a factor 1/2. Written for one pair in Eigen vectors, and by the
// schemes for many pairs at once (boltzmann/solid_collision.hpp).

#include <Eigen/Core>

namespace clca::boltzmann {

/// What a contact does to the relative velocity of the two points that touch. The ratio of the
/// tangential velocity after to that before is R = max(-roughness, 1 - A (V n) / |V_t|): friction
/// brakes the sliding until it ends (R = 0) or, with a roughness, is reversed (Walton 1993).
struct Law {
  double restitution = 1;  ///< epsilon, normal; 0 to 1
  double friction = 0;     ///< eta, of Coulomb; 0 or more, kNoSlidingLimit for none
  double roughness = 0;    ///< beta, tangential restitution; -1 (smooth) to 1 (reversed)

  bool operator==(const Law&) const = default;
};

/// Throws std::invalid_argument unless the numbers are in these ranges.
void check(const Law& law);

/// Friction of a law in which nothing slides: constant tangential restitution.
inline constexpr double kNoSlidingLimit = 1e300;

/// Radius, mass and inertia are positive: a precondition of what follows.
struct Sphere {
  double radius = 1;
  double mass = 1;
  double inertia = 0.4;  ///< moment of inertia about the centre; 0.4 mass radius^2 when solid
};

struct Motion {
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
  Eigen::Vector3d spin = Eigen::Vector3d::Zero();  ///< angular velocity
};

/// What two spheres are to a collision.
struct Pair {
  Sphere first;
  Sphere second;

  /// m1 m2 / (m1 + m2).
  double reduced_mass() const;
  /// K = 1/mu + a1^2/I1 + a2^2/I2.
  double compliance() const;
};

/// The motions of both, as seen in one collision.
struct Contact {
  Motion first;
  Motion second;
  /// Unit vector from the centre of the first to that of the second.
  Eigen::Vector3d normal = Eigen::Vector3d::UnitX();

  /// V = g + (a1 w1 + a2 w2) x n, of the points that touch; V n > 0 where they approach.
  Eigen::Vector3d slip(const Pair& pair) const;
};

/// A of eq. 19, put right: dimensionless, the same for all masses in a given ratio.
double friction_number(const Law& law, const Pair& pair);

/// R: 1 where nothing brakes, 0 where the contact sticks, -roughness where it rebounds.
double tangential_ratio(const Law& law, const Pair& pair, const Contact& contact);

/// The motions after the collision. The normal stays. Precondition: slip . normal >= 0.
Contact collide(const Law& law, const Pair& pair, const Contact& contact);

/// Energy that a collision takes away, by eqs. 24 to 26: not negative.
struct Loss {
  double normal = 0;      ///< of the motion along the normal
  double tangential = 0;  ///< of sliding and spin

  double total() const { return normal + tangential; }
};
Loss energy_loss(const Law& law, const Pair& pair, const Contact& contact);

}  // namespace clca::boltzmann
