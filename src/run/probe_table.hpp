#pragma once
// probes.csv: what the probes of a scene see.

#include <optional>
#include <string>

#include "clca/measure/snapshot.hpp"
#include "clca/scene/scene.hpp"
#include "clca/scene/units.hpp"
#include "clca/store/table.hpp"
#include "run/model.hpp"

namespace clca::run {

/// Columns: step, of the contact model time (scene::Conversion), stage, probe, filling, particles
/// (in it), vx, vy, fluctuation (see measure::RegionMotion; spacings per step, of the contact model
/// in the unit of velocity of scene::Conversion, and the square of that), flow (sites per step
/// since the last row, downwards). None where it has no value.
/// Of the automaton, motion is over the steps since the last row, of the particles that were in the
/// probe then; of the contact model, it is that at the row.
class ProbeTable {
 public:
  explicit ProbeTable(const scene::Scene& scene);

  /// Adds a row for each probe.
  void add(const std::string& stage, const Model& model);
  store::Table& table() { return table_; }
  /// At the last row.
  std::optional<measure::Snapshot>& last() { return last_; }

 private:
  std::vector<scene::Probe> probes_;
  std::optional<scene::Conversion> conversion_;
  store::Table table_;
  std::optional<measure::Snapshot> last_;
};

}  // namespace clca::run
