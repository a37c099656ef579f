#pragma once
// One gas of an ensemble, carried through all the times at which something is read off.

#include <cstdint>
#include <vector>

#include "clca/boltzmann/distribution.hpp"
#include "clca/boltzmann/gas.hpp"
#include "clca/boltzmann/observation.hpp"
#include "clca/boltzmann/scheme.hpp"
#include "clca/scene/boltzmann.hpp"

namespace clca::run {

/// Of the chi-square distribution that energies in space are held against.
inline constexpr int kGasDegrees = 3;

/// When a gas is looked at.
struct GasTime {
  double time = 0;
  bool in_series = false;
  bool in_histograms = false;
};

/// Times of the series (from 0, the end included) and of the histograms, ascending, each once.
std::vector<GasTime> gas_times(const scene::BoltzmannScene& scene);

boltzmann::Law law_of(const scene::BoltzmannScene& scene, double restitution);

boltzmann::Bins bins_of(const scene::BoltzmannScene& scene);

/// Over that at time 0; NaN where there was none.
double relative_temperature(double temperature, double start);

/// One quantity of a row of series.csv.
struct GasColumn {
  const char* name;
  double value;
};

/// What was read off a gas at one time.
struct GasObservation {
  boltzmann::Moments moments;
  double collisions = 0;  ///< per particle
  double dh_translational = 0;
  double dh_rotational = 0;
  boltzmann::EnergyShares shares;  ///< empty where no histogram is asked for

  /// The columns of series.csv after `time`, temperatures relative to `start`.
  std::vector<GasColumn> columns(const GasObservation& start, bool sheared) const;
};

struct GasMember {
  std::vector<GasObservation> observations;  ///< at the first of the times, all unless stopped
  std::uint64_t steps = 0;
  std::uint64_t participations = 0;
  std::uint64_t hash = 0;
};

/// Runs one; `keeps_on` is asked before each time and between steps.
GasMember run_member(const scene::BoltzmannScene& scene, double restitution, std::uint64_t seed,
                     int threads, const boltzmann::KeepsOn& keeps_on);

}  // namespace clca::run
