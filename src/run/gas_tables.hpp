#pragma once
// Tables of a Boltzmann run: means over the ensemble, with standard errors where there is one.

#include <vector>

#include "clca/boltzmann/law.hpp"
#include "clca/scene/boltzmann.hpp"
#include "clca/store/summary.hpp"
#include "run/gas_member.hpp"
#include "run/table.hpp"

namespace clca::run {

/// The ensemble for one restitution. After an interruption, means are over the members that got so
/// far.
struct GasCase {
  double restitution = 1;
  std::vector<GasMember> members;

  /// Number of observations of the most advanced member.
  std::size_t observations() const;
  /// The members that have this observation.
  std::vector<const GasMember*> at(std::size_t place) const;

  static constexpr auto fields() {
    using reflection::field;
    return std::make_tuple(field("restitution", &GasCase::restitution),
                           field("members", &GasCase::members));
  }
};

/// What rows of the tables are made of.
struct GasRow {
  const GasCase& gases;
  std::size_t place;  ///< of the observation
  double time;
};
struct GasBin {
  double restitution;
  std::string energy;
  double lower;
  std::optional<double> upper;
  statistics::Sample share;
  double reference;
};
struct GasClosure {
  double restitution;
  double time;
  double translational;
  double rotational = 0;
  double p_xx = 0;
  double p_yy = 0;
  double p_xy = 0;
};

/// series.csv, histogram-TIME.csv and, if closed forms exist, closure.csv.
class GasTables {
 public:
  explicit GasTables(const scene::BoltzmannScene& scene);

  std::vector<PlannedFile> files() const;
  /// Throws store::StoreError.
  void write(const store::OutputFolder& folder, const std::vector<GasCase>& cases);

 private:
  void add_bins(const GasCase& one, std::size_t place, const char* energy,
                std::vector<double> boltzmann::EnergyShares::*kind);
  void add_cooling(const GasCase& one);
  void add_steady_flow(const GasCase& one);

  const scene::BoltzmannScene& scene_;
  std::vector<GasTime> times_;
  TableWriter<GasRow, scene::BoltzmannScene> series_;
  TableWriter<GasBin, scene::BoltzmannScene> histogram_;
  TableWriter<GasClosure, scene::BoltzmannScene> closure_;
};

/// The last row of the series and further results of a case.
std::vector<store::NamedMeasure> gas_measures(const scene::BoltzmannScene& scene,
                                              const GasCase& one);

}  // namespace clca::run
