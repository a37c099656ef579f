#pragma once
// Forces between grains, and walls that push grains and are stalled.

#include <optional>
#include <string>
#include <vector>

#include "clca/contact/force.hpp"
#include "clca/measure/force_distribution.hpp"
#include "clca/scene/scene.hpp"
#include "run/model.hpp"

namespace clca::run {

/// Of the normal forces between grains; none without any.
std::optional<measure::ForceDistribution> distribution(const std::vector<contact::Force>& forces);

/// One line per stalled wall: since when, its travel, its overlaps.
std::vector<std::string> stall_lines(const scene::Scene& scene, const Model& model,
                                     const std::vector<double>& surface_at_start);

}  // namespace clca::run
