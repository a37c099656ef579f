#pragma once
// The measures of a stage: what each is, beside what takes its value.

#include <optional>
#include <vector>

#include "clca/measure/profile.hpp"
#include "clca/record/quantity.hpp"
#include "record/internal/observer.hpp"

namespace clca::record {

// Measures of a stage that are also columns of tables.
inline constexpr Quantity kVesselAngle = {"vessel_angle_deg", "Angle of the vessel", "degrees",
                                          "anticlockwise from upright"};
inline constexpr Quantity kHeightMean = {"height_mean", "Mean height", "spacings",
                                         "of the surface, over the columns with particles", true};
inline constexpr Quantity kReposeAngle = {"repose_angle_deg", "Slope", "degrees",
                                          "mean of the flanks that are there", true};
inline constexpr Quantity kReposeGravity = {
    "repose_gravity_deg", "Slope against gravity", "degrees",
    "mean of the flanks that are there, where gravity points down; all others are in the frame of "
    "the vessel"};
inline constexpr Quantity kIntruderHeight = {"intruder_height_rel", "Height of the intruder", "",
                                             "0 on the floor, 1 just buried at the top", true};
inline constexpr Quantity kSegregationIndex = {
    "segregation_index", "Segregation index", "",
    "height of the large ones over the small ones, over half the bed", true};
inline constexpr Quantity kLaceyIndex = {"lacey_index", "Lacey’s index of mixing", "",
                                         "0 separated, 1 as random"};

/// Value of kHeightMean; none without particles.
inline std::optional<double> bed_height(const std::vector<double>& profile) {
  const double height = measure::mean_height(profile);
  return height > 0 ? std::optional(height) : std::nullopt;
}

/// All quantities of a stage, in the order of the documents; of one measure, in that of run.json.
const std::vector<QuantityGroup>& stage_quantities();

// Groups of these with a source file of their own.
std::vector<QuantityGroup> outflow_quantities();
std::vector<std::string> names_by_outlet(const scene::Scene& scene);
std::vector<QuantityGroup> force_quantities();

std::vector<store::NamedMeasure> stage_measures(const StageView& stage);
/// The values of one measure alone, which the scene asks for.
std::vector<store::NamedMeasure> stage_measures(scene::Measure wanted, const StageView& stage);

/// Lines that say why the slope of a flank has no value, or that the box limits the run-out.
std::vector<std::string> measure_notes(const scene::Scene& scene, const model::SceneModel& model);

/// One line per stalled wall: since when, its travel, its overlaps.
std::vector<std::string> stall_messages(const scene::Scene& scene, const model::SceneModel& model,
                                        const std::vector<double>& surface_at_start);

/// `discharged.OUTLET` where there are several outlets, each followed by
/// `discharged.OUTLET.SPECIES` where there are several species. None if they are so many that
/// run.json would have too many measures. `particles`: measure::discharged_counts; empty: all 0.
std::vector<std::pair<std::string, std::uint64_t>> discharge_by_name(
    const scene::Scene& scene, std::vector<std::uint64_t> particles = {});

// Gases.
std::vector<Quantity> gas_quantities();
std::vector<TableInfo> gas_tables();

}  // namespace clca::record
