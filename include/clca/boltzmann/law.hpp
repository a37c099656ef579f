#pragma once
// The collision of two inelastic, frictional spheres.
//
// Ogawa & Kato 1982, eqs. 1 to 26, with a misprint corrected: A of (19) is eta K mu (1 + epsilon),
// for equal solid spheres 7 eta (1 + epsilon) / 2.

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

/// Law::friction without sliding: constant tangential restitution.
inline constexpr double kNoSlidingLimit = 1e300;

}  // namespace clca::boltzmann
