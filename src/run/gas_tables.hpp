#pragma once
// Tables of a Boltzmann run: means over the ensemble, with standard errors where there is one.

#include <vector>

#include "clca/boltzmann/law.hpp"
#include "clca/scene/boltzmann.hpp"
#include "clca/store/run_folder.hpp"
#include "clca/store/summary.hpp"
#include "run/gas_member.hpp"

namespace clca::run {

/// The ensemble for one restitution. Where the run was stopped, the means are over those members
/// that have come so far.
struct GasCase {
  double restitution = 1;
  std::vector<GasMember> members;

  /// Of the member that has come farthest.
  std::size_t observations() const;
  /// The members that have come to that observation.
  std::vector<const GasMember*> at(std::size_t place) const;

  static constexpr auto fields() {
    using fields::field;
    return std::make_tuple(field("restitution", &GasCase::restitution),
                           field("members", &GasCase::members));
  }
};

/// Mean over an ensemble; the error of a single run is NaN.
struct Estimate {
  double mean = 0;
  double standard_error = 0;
};
Estimate estimate(const std::vector<double>& values);

/// Writes series.csv, histogram-TIME.csv and, where there are closed forms, closure.csv.
/// Throws store::StoreError.
void write_tables(const scene::BoltzmannScene& scene, const std::vector<GasCase>& cases,
                  const store::RunFolder& folder);
/// Names of all tables that write_tables() may write.
std::vector<std::string> gas_table_names(const scene::BoltzmannScene& scene);

/// The last row of the series, with what else is to be known of a case.
std::vector<store::NamedMeasure> gas_measures(const scene::BoltzmannScene& scene,
                                              const GasCase& one);

}  // namespace clca::run
