#pragma once
// series.csv: the time series of a run.

#include <string>

#include "clca/scene/scene.hpp"
#include "clca/scene/units.hpp"
#include "clca/store/table.hpp"
#include "run/model.hpp"
#include "run/records.hpp"

namespace clca::run {

/// Columns: step, of the contact model time (scene::Conversion), stage, particles (present),
/// moving, moving_share, mean_height (of the centres, weighted by sites, in lattice spacings),
/// discharged_particles, discharged_sites (totals); of the contact model kinetic_energy and
/// potential_energy (see contact::Energy), dissipated_energy (see EnergyRecord) and, with what the
/// scene has, source_energy, outlet_energy, wall_work and vessel_work (see contact::EnergyExchange;
/// since the start of the stage); for each wall that moves travel.NAME (sites from home), and where
/// it lets overlap index.NAME (sites that overlap in all contacts that began at it);
/// discharge_names (totals).
class SeriesTable {
 public:
  explicit SeriesTable(const scene::Scene& scene);

  /// Adds a row if one is due, or `always`, but not a second one for a step; whether it has.
  bool add(const std::string& stage, const Model& model, const Records& records, std::size_t moving,
           bool always);
  store::Table& table() { return table_; }
  /// The last step that has a row.
  std::optional<std::uint64_t>& last_step() { return last_step_; }

 private:
  const scene::Scene& scene_;
  std::optional<scene::Conversion> conversion_;
  bool has_vessel_;
  store::Table table_;
  std::optional<std::uint64_t> last_step_;
};

}  // namespace clca::run
