#pragma once
// What a run says of stalled walls; measures and tables of forces are observers (forces.cpp).

#include <string>
#include <vector>

#include "clca/scene/scene.hpp"
#include "model/internal/scene_model.hpp"

namespace clca::record {

/// One line per stalled wall: since when, its travel, its overlaps.
std::vector<std::string> stall_lines(const scene::Scene& scene, const model::SceneModel& model,
                                     const std::vector<double>& surface_at_start);

}  // namespace clca::record
