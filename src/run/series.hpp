#pragma once
// series.csv: the course of a run.

#include <string>

#include "clca/automaton/automaton.hpp"
#include "clca/scene/scene.hpp"
#include "clca/store/table.hpp"

namespace clca::run {

/// Columns: step, stage, particles (present), moving, moving_share, mean_height (of the centres,
/// weighted by sites, in lattice spacings), discharged_particles, discharged_sites (totals).
class SeriesTable {
 public:
  explicit SeriesTable(const scene::Series& series);

  /// Takes a row when the interval says so, or `always`.
  void add(const std::string& stage, const automaton::State& state, std::size_t moving,
           bool always);
  std::string to_csv() const { return table_.to_csv(); }

 private:
  std::uint64_t every_;
  store::Table table_;
  std::optional<std::uint64_t> last_step_;
};

}  // namespace clca::run
