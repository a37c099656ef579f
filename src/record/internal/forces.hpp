#pragma once
// Walls that push grains and are stalled.

#include <string>
#include <vector>

#include "clca/scene/scene.hpp"
#include "model/internal/scene_model.hpp"

namespace clca::record {

/// One line per stalled wall: since when, its travel, its overlaps.
std::vector<std::string> stall_lines(const scene::Scene& scene, const model::SceneModel& model,
                                     const std::vector<double>& surface_at_start);

}  // namespace clca::record
