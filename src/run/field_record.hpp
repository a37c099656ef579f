#pragma once
// fields.csv: packing, velocity and fluctuation on a grid, for each window, and the distribution of
// fluctuation energies.

#include <optional>
#include <string>

#include "clca/measure/field_grid.hpp"
#include "clca/measure/fluctuation.hpp"
#include "clca/scene/scene.hpp"
#include "clca/scene/units.hpp"
#include "clca/store/table.hpp"

namespace clca::run {

/// Columns: stage, step (end of the window), of the contact model time, x, y (centre of the cell),
/// packing, particles, vx, vy (spacings per step; of the contact model in the unit of velocity of
/// scene::Conversion), fluctuation (in the square of that). Cells without particles and packing are
/// left out.
class FieldRecord {
 public:
  FieldRecord(const scene::Fields& fields, const std::optional<scene::Conversion>& conversion);

  /// Also for a resumed stage; the members listed by fields() are loaded afterwards.
  void begin_stage(const std::string& stage, const grains::State& state);
  /// Call after each step: ends a window when it is due.
  void after_step(const grains::State& state);
  /// Ends the last window, even if it is short.
  void end_stage(const grains::State& state);

  /// Mean over the windows of the stage, weighted by their steps; in the unit of the column.
  double fluctuation_energy() const;
  store::Table& table() { return table_; }

  /// Over the complete windows of the stage.
  const measure::Fluctuations& fluctuations() const { return fluctuations_; }
  /// Columns lower, upper (of the energy X; none for the last bin), share, share_local, reference.
  std::string fluctuation_csv() const;

  /// False if this cannot have been recorded in a run that reached `now`.
  bool precedes(const grains::State& now) const;
  static constexpr auto fields() {
    using reflection::field;
    return std::make_tuple(field("window", &FieldRecord::window_),
                           field("fluctuations", &FieldRecord::fluctuations_),
                           field("window_begin", &FieldRecord::window_begin_),
                           field("fluctuation_steps", &FieldRecord::fluctuation_steps_),
                           field("steps", &FieldRecord::steps_));
  }

 private:
  void end_window(const grains::State& state);

  scene::Fields fields_;
  std::optional<scene::Conversion> conversion_;
  double speed_ = 1;  // a lattice spacing per step, in the unit of velocity
  std::string stage_;
  store::Table table_;
  std::optional<measure::FieldWindow> window_;
  measure::Fluctuations fluctuations_;
  std::uint64_t window_begin_ = 0;  // step
  double fluctuation_steps_ = 0;    // sum of fluctuation x steps
  std::uint64_t steps_ = 0;
};

}  // namespace clca::run
