#pragma once
// Measures of the forces of pushing walls.

#include <string>
#include <vector>

#include "clca/scene/scene.hpp"
#include "clca/store/summary.hpp"
#include "run/force_record.hpp"
#include "run/model.hpp"

namespace clca::run {

/// Adds the index of force, its distribution, how far walls have moved and since when they are
/// stalled.
void add_force(std::vector<store::NamedMeasure>& results, const Model& model,
               const std::vector<double>& surface_at_start, const ForceRecord& record);

/// One line per stalled wall: since when, its travel, its overlaps.
std::vector<std::string> stall_lines(const scene::Scene& scene, const Model& model,
                                     const std::vector<double>& surface_at_start);

}  // namespace clca::run
