#pragma once
// Observables of a gas at one time.

#include <vector>

#include "clca/boltzmann/gas.hpp"
#include "clca/reflection/reflection.hpp"
#include "clca/statistics/sample.hpp"

namespace clca::boltzmann {

struct Moments {
  double translational = 0;     ///< <v^2>/3, in v0^2
  double rotational = 0;        ///< <w^2>/3, in v0^2
  double a2_translational = 0;  ///< 3 <v^4> / (5 <v^2>^2) - 1, the second cumulant
  double a2_rotational = 0;
  double correlation = 0;  ///< <v^2 w^2> / (<v^2> <w^2>) - 1
  double alignment = 0;    ///< of axes: (3 <(v w)^2> - <v^2 w^2>) / (<v^2> <w^2>)
  double p_xx = 0;         ///< 3 <v_x^2> / <v^2>, of the pressure tensor
  double p_yy = 0;
  double p_xy = 0;

  CLCA_FIELDS(translational, rotational, a2_translational, a2_rotational, correlation, alignment,
              p_xx, p_yy, p_xy);
};

/// Summed in a fixed order: the same bits for any number of threads. Zero spin gives zeros.
/// Throws std::invalid_argument if there are no particles.
Moments moments(const Motions& motions);

/// Shares per bin of X = |v|^2 / v0^2 and |w|^2 / w0^2, each with its present scale.
struct EnergyShares {
  std::vector<double> translational;
  std::vector<double> rotational;

  CLCA_FIELDS(translational, rotational);
};
EnergyShares energy_shares(const Motions& motions, const Moments& moments,
                           const statistics::Bins& bins);

}  // namespace clca::boltzmann
