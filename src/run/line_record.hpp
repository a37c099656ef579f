#pragma once
// lines-STAGE.csv: means over a stage on the lines of a scene.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "clca/measure/line.hpp"
#include "clca/scene/scene.hpp"
#include "clca/scene/units.hpp"
#include "run/model.hpp"

namespace clca::run {

/// Observes the lines at the steps that have rows in series.csv.
class LineRecord {
 public:
  /// The scene has Output::series.
  explicit LineRecord(const scene::Scene& scene);

  /// Also for a resumed stage; the members listed by fields() are loaded afterwards.
  void begin_stage(const grains::State& state);
  /// Call after each step.
  void after_step(const Model& model);
  /// Observes the steps since the last row.
  void end_stage(const Model& model);

  /// Columns: line, position (from the start of the line), x, y (of the middle of the part), flux
  /// (sites per step and spacing, to the right), v_across, v_along (spacings per step; of the
  /// contact model in the unit of velocity of scene::Conversion), filling, particles; standard
  /// errors are in columns NAME_se. See measure::LinePart. None where it has no value.
  std::string csv() const;

  /// False if this cannot have been recorded in a run that reached `now`.
  bool precedes(const grains::State& now) const;
  static constexpr auto fields() {
    using reflection::field;
    return std::make_tuple(field("last", &LineRecord::last_), field("sums", &LineRecord::sums_));
  }

 private:
  void observe(const Model& model);

  std::uint64_t every_;  // steps
  std::optional<scene::Conversion> conversion_;
  std::vector<scene::Line> scene_lines_;
  std::vector<measure::Line> lines_;  // the same, of this stage
  measure::Snapshot last_;            // at the last row
  std::vector<measure::LineSums> sums_;
};

}  // namespace clca::run
