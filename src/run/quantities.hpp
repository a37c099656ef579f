#pragma once
// The measures of a stage: what each is, beside what takes its value.

#include <optional>
#include <vector>

#include "clca/run/quantity.hpp"
#include "clca/scene/scene.hpp"
#include "clca/store/summary.hpp"
#include "run/model.hpp"
#include "run/records.hpp"
#include "run/stage_measures.hpp"

namespace clca::run {

/// Of a stage and of series.csv.
inline constexpr Quantity kVesselAngle = {"vessel_angle_deg", "Angle of the vessel", "degrees",
                                          "anticlockwise from upright"};

/// A stage at its end.
struct StageView {
  const scene::Scene& scene;
  const Model& model;
  const StageHistory& history;
  const Records& records;
};

/// Quantities that are taken together.
struct QuantityGroup {
  std::optional<scene::Measure> measure;  ///< that asks for it; none: always taken
  std::string_view condition;             ///< Markdown: when there are values; empty: always
  std::vector<Quantity> quantities;
  /// In the order of the quantities; none where the condition does not hold.
  std::vector<store::MeasureValue> (*values)(const StageView& stage);
  /// The same, or a part of it, of each outlet or species; may be null.
  std::vector<store::NamedMeasure> (*apart)(const StageView& stage) = nullptr;
};

std::vector<QuantityGroup> outflow_quantities();
std::vector<QuantityGroup> force_quantities();

/// All of a stage, in the order of the documents; those of one measure in that of run.json.
const std::vector<QuantityGroup>& stage_quantities();

/// Of series.csv, and of gases.
const std::vector<Quantity>& series_quantities();
const std::vector<Quantity>& gas_quantities();

}  // namespace clca::run
