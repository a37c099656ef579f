#pragma once
// One gas of an ensemble and its observations.

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "clca/boltzmann/gas.hpp"
#include "clca/boltzmann/observation.hpp"
#include "clca/boltzmann/scheme.hpp"
#include "clca/reflection/reflection.hpp"
#include "clca/scene/boltzmann.hpp"
#include "clca/statistics/sample.hpp"

namespace clca::model {

/// Degrees of freedom of the chi-square distribution of energies in space.
inline constexpr int kGasDegrees = 3;

/// A time of observation.
struct ObservationTime {
  double time = 0;
  bool in_series = false;
  bool in_histograms = false;

  bool operator==(const ObservationTime&) const = default;
};

/// Times of the series (from 0 to the end) and of the histograms, ascending, without duplicates.
std::vector<ObservationTime> observation_times(const scene::BoltzmannScene& scene);

/// Number of initial observation times that two scenes share, with the same steps up to then.
std::size_t shared_time_count(const std::vector<ObservationTime>& one,
                              const std::vector<ObservationTime>& other);

/// Number of initial times shared with a scene that only runs longer: all, or all but the end.
std::size_t lasting_time_count(const scene::BoltzmannScene& scene);

statistics::Bins energy_bins(const scene::BoltzmannScene& scene);

/// Unit of rotational temperatures: that of time 0, or the translational one if there is no spin.
double rotational_temperature_unit(double translational, double rotational);

/// Observation of a gas at one time.
struct GasObservation {
  boltzmann::Moments moments;
  double collisions = 0;  ///< per particle
  /// Hellinger distances of the shares from those of Maxwell-Boltzmann.
  double dh_translational = 0;
  double dh_rotational = 0;
  boltzmann::EnergyShares shares;  ///< empty where no histogram is asked for

  CLCA_FIELDS(moments, collisions, dh_translational, dh_rotational, shares);
};

/// A gas of an ensemble and its observations so far.
struct GasMember {
  std::vector<GasObservation> observations;  ///< at the first of the times, all at the end
  std::optional<boltzmann::Gas> gas;         ///< while it is under way
  /// The gas at the last time shared with a longer run, from where the end can be moved.
  std::optional<boltzmann::Gas> lasting;
  // Counts and hash of the gas when record_counts() was called.
  std::uint64_t steps = 0;
  std::uint64_t participations = 0;
  std::uint64_t hash = 0;

  /// Sets these three from the gas, which is under way.
  void record_counts();

  CLCA_FIELDS(observations, gas, lasting, steps, participations, hash);
};

/// Advances the members of a scene through its observation times.
class GasIntegrator {
 public:
  explicit GasIntegrator(const scene::BoltzmannScene& scene);

  /// Advances a member to the end, or until `keep_going`, called before each time and after each
  /// step, returns false. The result does not depend on stops or threads.
  void integrate(GasMember& member, double restitution, std::uint64_t seed, int threads,
                 const std::function<bool(const GasMember&)>& keep_going) const;

  const std::vector<ObservationTime>& times() const { return times_; }

 private:
  GasObservation observe(const boltzmann::Gas& gas, bool in_histograms) const;

  const scene::BoltzmannScene& scene_;
  std::vector<ObservationTime> times_;
  std::size_t lasting_times_;
  bool keeps_lasting_;
  statistics::Bins bins_;
  std::vector<double> reference_shares_;  // of Maxwell-Boltzmann
};

}  // namespace clca::model
