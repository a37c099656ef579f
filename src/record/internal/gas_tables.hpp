#pragma once
// Tables of a Boltzmann run: means over the ensemble, with standard errors where there is one.

#include <vector>

#include "clca/boltzmann/scheme.hpp"
#include "clca/scene/boltzmann.hpp"
#include "clca/store/summary.hpp"
#include "model/internal/gas_member.hpp"
#include "record/internal/table.hpp"

namespace clca::record {

/// The ensemble for one restitution. Means are over the members that have come so far.
struct GasCase {
  double restitution = 1;
  std::vector<model::GasMember> members;

  /// Number of observations of the most advanced member.
  std::size_t observation_count() const;
  /// The members that have the observation of this number.
  std::vector<const model::GasMember*> members_with(std::size_t observation) const;

  CLCA_FIELDS(restitution, members);
};

/// Writes series.csv, histogram-TIME.csv and, if closed forms exist, closure.csv. Throws
/// store::StoreError.
void write_gas_tables(const scene::BoltzmannScene& scene, const std::vector<GasCase>& cases,
                      const store::OutputFolder& folder);
std::vector<store::TableSummary> gas_table_summaries(const scene::BoltzmannScene& scene);

/// The last row of the series and further results of a case.
std::vector<store::NamedMeasure> gas_measures(const scene::BoltzmannScene& scene,
                                              const GasCase& gas_case);

}  // namespace clca::record
