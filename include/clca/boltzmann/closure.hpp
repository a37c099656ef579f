#pragma once
// Closed forms to compare the simulation with. Units as in gas.hpp; A = 7 friction (1 +
// restitution) / 2 for equal solid spheres.

#include "clca/boltzmann/scheme.hpp"

namespace clca::boltzmann {

/// <v^2>/3 and <w^2>/3.
struct Temperatures {
  double translational = 1;
  double rotational = 1;

  bool operator==(const Temperatures&) const = default;
};

/// Collision rate of a particle in a Maxwellian gas: (4 / sqrt(pi)) sqrt(T).
double maxwellian_collision_rate(double translational);

/// Rates of change of both temperatures. Exact while velocities and spins are normal and
/// independent, a closure otherwise.
Temperatures temperature_rates(const Law& law, const Temperatures& temperatures);

/// Both temperatures after `duration`, integrated by Runge-Kutta of order 4.
/// Throws std::invalid_argument for an invalid law (check_valid) or an infinite duration.
Temperatures temperatures_after(const Law& law, const Temperatures& begin, double duration);

/// Uniform shear flow of smooth spheres (kinetic model of Brey, Dufty & Santos 1999).
struct ShearFlow {
  double temperature = 0;  ///< steady, in v0^2
  double p_xx = 0;         ///< relative to the mean pressure, as in Moments
  double p_yy = 0;
  double p_xy = 0;
};
/// Throws std::invalid_argument unless 0 <= restitution < 1 and the shear rate is positive.
ShearFlow steady_shear_flow(double restitution, double shear_rate);

}  // namespace clca::boltzmann
