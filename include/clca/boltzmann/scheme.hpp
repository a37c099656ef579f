#pragma once
// The collision of two inelastic, frictional spheres, and time integration of a gas.
//
// The law of a collision: Ogawa & Kato 1982, eqs. 1 to 26, with a misprint corrected: A of (19) is
// eta K mu (1 + epsilon), for equal solid spheres 7 eta (1 + epsilon) / 2.

#include <cstdint>
#include <functional>
#include <limits>
#include <variant>

#include "clca/boltzmann/gas.hpp"

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
void check_valid(const Law& law);

/// Law::friction without sliding: constant tangential restitution.
inline constexpr double kNoSlidingLimit = 1e300;

/// Exact scheme: candidate pairs at a rate that bounds the collision rate from above (majorant),
/// accepted with the ratio of both rates. Both particles change. Conserves momentum.
struct Majorant {
  bool operator==(const Majorant&) const = default;
};

/// Ogawa & Kato 1982, eqs. 35 to 38, as printed: in each step a particle draws partners and
/// collides with one of them with probability 1 - exp(-gamma dt). Only this particle changes.
/// Biased, see docs/boltzmann.md.
struct OgawaKato {
  double time_step = 0.025;  ///< greater than 0
  int partner_count = 10;    ///< at least 1
  /// Draws from a randomly shifted rank-1 lattice, with the particles sorted by speed.
  bool quasi_random = false;

  bool operator==(const OgawaKato&) const = default;
};

/// Relative growth of <v^2> by `time` that the bias of the scheme causes in a gas of constant
/// energy (restitution 1, no friction); infinite if it diverges.
/// Derived: with T = <v^2>/3, to second order in the step, a Maxwellian gas has dT/dt = T^2 C dt (1
/// - 1/partners) (1 - 1.749 dt T^(1/2)), C = <gamma_a |v_a - v_b| (a^2 - b^2)>/12
/// = 0.27566 at T = 1.
/// Measured with 100 000 particles, 10 partners, t = 15: 0.09 +- 0.02 for steps of 0.025, 0.19 +-
/// 0.02 for 0.05, 0.44 +- 0.02 for 0.1 (expected: 0.098, 0.206, 0.463).
inline double expected_heating(const OgawaKato& scheme, double time) {
  constexpr double kFirstOrder = 0.27566;
  constexpr double kSecondOrder = 1.749;
  const double step = scheme.time_step / (1 + kSecondOrder * scheme.time_step);
  const double lost = kFirstOrder * (1 - 1.0 / scheme.partner_count) * step * time;
  return lost < 1 ? lost / (1 - lost) : std::numeric_limits<double>::infinity();
}

using Scheme = std::variant<Majorant, OgawaKato>;

/// Law, scheme and shear by which a gas advances.
struct Dynamics {
  Law law;
  Scheme scheme;
  /// Velocity gradient du_x/dy of uniform shear flow, to which velocities are then relative.
  double shear_rate = 0;
};

/// Asked between steps; false stops the advance.
using ContinueCondition = std::function<bool(const Gas&)>;

/// Advances `gas` to `time`, or until `keep_going` returns false after a step. The result does not
/// depend on `threads`.
/// Throws std::invalid_argument for fewer than 1 thread or 2 particles, a time that is not finite,
/// or a law, scheme or shear rate out of range. Other exceptions may leave the gas within a step.
void advance(Gas& gas, const Dynamics& process, std::uint64_t seed, double time, int threads,
             const ContinueCondition& keep_going = {});

}  // namespace clca::boltzmann
