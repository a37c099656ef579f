#pragma once
// A homogeneous gas of equal solid spheres, as a sample of its distribution.
//
// Units: the mass of a sphere is 1; velocities in v0 = sqrt(<v^2>/3) at time 0; spins as surface
// velocities w = a omega, also in v0, so that their energy is (2/5) w^2 / 2; time in
// 1 / (pi N (2 a)^2 v0).

#include <Eigen/Core>
#include <cstdint>

#include "clca/reflection/reflection.hpp"

namespace clca::boltzmann {

/// One column per particle: velocity in rows 0 to 2, spin in rows 3 to 5. Column-major: 48
/// contiguous bytes per particle.
using Motions = Eigen::Array<double, 6, Eigen::Dynamic>;

struct Gas {
  Motions motions;
  double time = 0;
  std::uint64_t step = 0;  ///< step of the scheme; key of its draws
  /// Number of collisions summed over particles: it counts twice if both particles change.
  std::uint64_t participations = 0;
  double thermal_speed = 1;  ///< sqrt(<v^2>/3) after the last step; sets the next step length

  Eigen::Index particle_count() const { return motions.cols(); }
  double collisions_per_particle() const {
    return static_cast<double>(participations) / static_cast<double>(particle_count());
  }
  CLCA_FIELDS(time, step, participations, thermal_speed, motions);
};

/// Covers all members: equal for equal bits.
std::uint64_t hash(const Gas& gas);

enum class InitialDistribution : std::uint8_t {
  gaussian,     ///< case 1: velocity and spin normal and independent
  equal_energy  ///< case 2: |v| and |w| the same for all, directions isotropic and independent
};

struct InitialCondition {
  std::uint64_t particle_count = 10'000;
  InitialDistribution distribution = InitialDistribution::gaussian;
  double energy_ratio = 1;  ///< C_e = I <omega^2> / (m <v^2>); 0 or more
  /// Shifts and scales the sample to zero mean velocity and spin and exact mean squares.
  bool exact_moments = true;
  /// Samples from a randomly shifted rank-1 lattice instead of independent points.
  bool quasi_random = false;
};

/// Throws std::invalid_argument unless 2 to 2^32 - 1 particles and a finite energy ratio >= 0.
Gas make_gas(const InitialCondition& condition, std::uint64_t seed);

/// Seed of a member of an ensemble; member 0 has `seed` itself.
std::uint64_t member_seed(std::uint64_t seed, std::uint64_t member);

}  // namespace clca::boltzmann
