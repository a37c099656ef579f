#pragma once
// cycles.csv and convection: results of each cycle of periodic walls or of the vessel.

#include <optional>
#include <vector>

#include "clca/contact/vessel.hpp"
#include "clca/measure/convection.hpp"
#include "record/internal/observer.hpp"

namespace clca::record {

/// What a row of cycles.csv is made of.
struct CycleRow {
  const StageView& now;
  std::uint64_t cycle;
  std::vector<double> profile;
  double cell_side;

  const grains::State& state() const { return now.model.state(); }
};

class CycleRecord : public SavedObserver<CycleRecord> {
 public:
  explicit CycleRecord(const scene::Scene& scene);

  static double bytes(const scene::Scene& scene, double particles);

  void begin_stage(const StageView& now) override;
  void after_step(const StageView& now) override;
  void end_stage(const StageView& now) override;
  std::vector<RunTable*> tables() override { return {&cycles_table_, &convection_table_}; }

  /// Cycles completed in this stage by all periodic walls and the vessel. A wave counts from its
  /// position at the start of the stage; an interrupted shake completes its cycle first.
  std::uint64_t completed_cycles() const { return cycles_; }
  /// Null if no wall is periodic in this stage and the vessel does not turn or shake.
  const measure::Convection* convection() const { return convection_ ? &*convection_ : nullptr; }
  /// Side of the cells of Lacey's index and the convection, in lattice spacings.
  double cell_side() const { return cell_; }

  bool precedes(const grains::State& now) const;
  static constexpr const char* kPath = "records/cycles";
  CLCA_FIELDS(cycles_, at_start_, convection_);

 private:
  void prepare(const StageView& now) override;
  std::uint64_t count_completed_cycles(const StageView& now) const;
  void add_row(const StageView& now);

  double cell_;
  std::uint64_t cycles_ = 0;
  std::vector<grains::Travel> at_start_;  // by wall: when the stage began; cycles count from it
  std::optional<measure::Convection> convection_;
  TableWriter<CycleRow> cycles_table_;
  TableWriter<measure::ConvectionArrow> convection_table_;
};

}  // namespace clca::record
