#pragma once
// series.csv: the time series of a run.

#include <optional>
#include <string>

#include "clca/scene/scene.hpp"
#include "clca/store/table.hpp"
#include "run/model.hpp"
#include "run/records.hpp"

namespace clca::run {

/// Columns: those of series_quantities() that the scene has; for each wall that moves travel.NAME,
/// and where it lets overlap index.NAME; discharge_names.
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
  store::Table table_;
  std::optional<std::uint64_t> last_step_;
};

}  // namespace clca::run
