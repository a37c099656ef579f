#pragma once
// How a gas is carried through time.

#include <atomic>
#include <cstdint>
#include <functional>
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
  double time_step = 0.025;
  int partners = 10;
  /// Draws from a randomly shifted rank-1 lattice, the particles sorted by speed.
  bool quasi = false;

  bool operator==(const OgawaKato&) const = default;
};

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
/// on `threads`.
void advance(Gas& gas, const Process& process, std::uint64_t seed, double time, int threads,
             const KeepsOn& keeps_on = {});

}  // namespace clca::boltzmann
