#pragma once
// One gas of an ensemble, carried through all the times at which something is read off.

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "clca/boltzmann/distribution.hpp"
#include "clca/boltzmann/gas.hpp"
#include "clca/boltzmann/observation.hpp"
#include "clca/boltzmann/scheme.hpp"
#include "clca/fields/fields.hpp"
#include "clca/scene/boltzmann.hpp"

namespace clca::run {

/// Of the chi-square distribution that energies in space are held against.
inline constexpr int kGasDegrees = 3;

/// When a gas is looked at.
struct GasTime {
  double time = 0;
  bool in_series = false;
  bool in_histograms = false;

  bool operator==(const GasTime&) const = default;
};

/// Times of the series (from 0, the end included) and of the histograms, ascending, each once.
std::vector<GasTime> gas_times(const scene::BoltzmannScene& scene);

/// How many of the first times two scenes share, that is gases, too, as they are cut there: the
/// kind of energies that is read off has to be the same.
std::size_t shared_times(const std::vector<GasTime>& one, const std::vector<GasTime>& other);

/// How many of the first times the scene shares with one that only goes on longer: all, or all but
/// the end.
std::size_t lasting_times(const scene::BoltzmannScene& scene);

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

  static constexpr auto fields() {
    using fields::field;
    return std::make_tuple(field("moments", &GasObservation::moments),
                           field("collisions", &GasObservation::collisions),
                           field("dh_translational", &GasObservation::dh_translational),
                           field("dh_rotational", &GasObservation::dh_rotational),
                           field("shares", &GasObservation::shares));
  }
};

/// A gas of an ensemble, as far as it has come.
struct GasMember {
  std::vector<GasObservation> observations;  ///< at the first of the times, all at the end
  std::optional<boltzmann::Gas> gas;         ///< while it is under way
  /// As it was at the last time that a longer run has, too, once it has come there: from here on
  /// the end of the run may be moved. None where runs do not keep it.
  std::optional<boltzmann::Gas> lasting;
  std::uint64_t steps = 0;  ///< this and the rest: of the gas when count() was called
  std::uint64_t participations = 0;
  std::uint64_t hash = 0;

  /// Takes the numbers of the gas.
  void count();

  static constexpr auto fields() {
    using fields::field;
    return std::make_tuple(
        field("observations", &GasMember::observations), field("gas", &GasMember::gas),
        field("lasting", &GasMember::lasting), field("steps", &GasMember::steps),
        field("participations", &GasMember::participations), field("hash", &GasMember::hash));
  }
};

/// What carries the members of a scene through its times.
class GasCarrier {
 public:
  explicit GasCarrier(const scene::BoltzmannScene& scene);

  /// From where the member stands, or from the beginning, to the end; stops where `keeps_on`, asked
  /// before each time and after each step, says no. The bits do not depend on stops and threads.
  void carry(GasMember& member, double restitution, std::uint64_t seed, int threads,
             const std::function<bool(const GasMember&)>& keeps_on) const;

  const std::vector<GasTime>& times() const { return times_; }

 private:
  GasObservation observe(const boltzmann::Gas& gas, bool in_histograms) const;
  double distance(const std::vector<double>& shares) const;
  /// Keeps the gas where the scene wants it.
  void keep_lasting(GasMember& member) const;

  const scene::BoltzmannScene& scene_;
  std::vector<GasTime> times_;
  std::size_t lasting_times_;
  bool keeps_lasting_;
  boltzmann::Bins bins_;
  std::vector<double> reference_;
};

}  // namespace clca::run
