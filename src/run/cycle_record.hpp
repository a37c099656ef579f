#pragma once
// cycles.csv and the convection of a stage: results of each cycle of periodic walls or of the
// vessel.

#include <optional>
#include <string>
#include <vector>

#include "clca/contact/vessel.hpp"
#include "clca/grains/state.hpp"
#include "clca/measure/convection.hpp"
#include "clca/scene/scene.hpp"
#include "clca/scene/units.hpp"
#include "clca/store/table.hpp"

namespace clca::run {

/// Columns: stage, cycle (0: before the first), step, time where steps have a length, height_mean,
/// repose_angle_deg, intruder_height_rel, segregation_index, lacey_index; empty where there is
/// none.
class CycleRecord {
 public:
  /// `cell`: side of the cells of Lacey's index and the convection, in lattice spacings.
  CycleRecord(double cell, const scene::Scene& scene);

  void begin_stage(const scene::Scene& scene, const scene::Stage& stage, const grains::State& state,
                   const contact::Vessel& vessel);
  /// Prepares for resuming a stage; the members listed by fields() are loaded afterwards.
  void resume_stage(const scene::Scene& scene, const scene::Stage& stage,
                    const grains::State& state);
  /// Call after each step.
  void after_step(const grains::State& state, const contact::Vessel& vessel);

  /// Cycles completed in this stage by all periodic walls and the vessel. A wave counts from its
  /// position at the start of the stage; an interrupted shake completes its cycle first.
  std::uint64_t cycles() const { return cycles_; }
  /// Null if no wall is periodic in this stage and the vessel does not turn or shake.
  const measure::Convection* convection() const { return convection_ ? &*convection_ : nullptr; }
  double cell() const { return cell_; }
  store::Table& table() { return table_; }
  /// Columns x, y, dx, dy (mean displacement per cycle, lattice spacings), weight (sites).
  std::string convection_csv() const;

  /// False if this cannot have been recorded in a run that reached `now`.
  bool precedes(const grains::State& now) const;
  static constexpr auto fields() {
    using reflection::field;
    return std::make_tuple(field("cycles", &CycleRecord::cycles_),
                           field("at_start", &CycleRecord::at_start_),
                           field("convection", &CycleRecord::convection_));
  }

 private:
  std::uint64_t completed(const grains::State& state, std::uint64_t of_vessel) const;
  void add_row(const grains::State& state, const contact::Vessel& vessel);

  double cell_;
  std::optional<scene::Conversion> conversion_;
  bool has_vessel_;  // and a box with sides
  std::string stage_;
  bool vessel_has_cycles_ = false;
  std::uint64_t cycles_ = 0;
  std::vector<grains::Travel> at_start_;  // by wall
  std::optional<measure::Convection> convection_;
  store::Table table_;
};

}  // namespace clca::run
