#pragma once
// How a gas is carried through time.

#include <cstdint>
#include <functional>
#include <limits>
#include <variant>

#include "clca/boltzmann/gas.hpp"
#include "clca/boltzmann/law.hpp"

namespace clca::boltzmann {

/// Pairs in continuous time: candidates at a rate that majorises that of collisions, accepted with
/// the ratio of both; both particles change. Conserves momentum.
struct Majorant {
  bool operator==(const Majorant&) const = default;
};

/// Ogawa & Kato 1982, eqs. 35 to 38, as printed: in each time step every particle draws partners
/// and collides with one of them with probability 1 - exp(-gamma dt); only it changes. Biased, see
/// docs/boltzmann.md.
struct OgawaKato {
  double time_step = 0.025;  ///< greater than 0
  int partners = 10;         ///< at least 1
  /// Draws from a randomly shifted rank-1 lattice, the particles sorted by speed.
  bool quasi = false;

  bool operator==(const OgawaKato&) const = default;
};

/// By what share <v^2> of a gas of constant energy (restitution 1, no friction) has grown at `time`
/// through the bias of the scheme; infinite where it runs away.
///
/// Derived: with T = <v^2>/3, and to second order in the step, a Maxwellian gas has dT/dt = T^2
/// C dt (1 - 1/partners) (1 - 1.749 dt T^(1/2)), where C = <gamma_a |v_a - v_b| (a^2 - b^2)> / 12 =
/// 0.27566 at T = 1: the fast collide too seldom. One partner alone does not heat. Measured with
/// 100 000 particles and 10 partners at t = 15: 0.09 +- 0.02 for steps of 0.025, 0.19 +- 0.02 for
/// 0.05, 0.44 +- 0.02 for 0.1 (expected: 0.098, 0.206, 0.463).
inline double expected_heating(const OgawaKato& scheme, double time) {
  constexpr double kFirstOrder = 0.27566;
  constexpr double kSecondOrder = 1.749;
  const double step = scheme.time_step / (1 + kSecondOrder * scheme.time_step);
  const double lost = kFirstOrder * (1 - 1.0 / scheme.partners) * step * time;
  return lost < 1 ? lost / (1 - lost) : std::numeric_limits<double>::infinity();
}

using Scheme = std::variant<Majorant, OgawaKato>;

struct Process {
  Law law;
  Scheme scheme;
  /// Velocity gradient d u_x / d y of uniform shear flow, in 1 / time unit; velocities are then
  /// those relative to the flow.
  double shear_rate = 0;
};

/// Where an advance may stop early: looked at between steps.
using KeepsOn = std::function<bool(const Gas&)>;

/// Carries `gas` to `time`, or until `keeps_on` says no after a step. The result does not depend
/// on `threads`. Throws std::invalid_argument for less than 1 of them, fewer than 2 particles, a
/// time that is not finite, or a law, scheme or shear rate out of range. After any other exception
/// (std::bad_alloc, or what `keeps_on` has thrown) the gas may be half stepped.
void advance(Gas& gas, const Process& process, std::uint64_t seed, double time, int threads,
             const KeepsOn& keeps_on = {});

}  // namespace clca::boltzmann
