#pragma once
// The measures of what walls press into.

#include <string>
#include <vector>

#include "clca/scene/scene.hpp"
#include "clca/store/summary.hpp"
#include "run/force_record.hpp"
#include "run/model.hpp"

namespace clca::run {

/// Adds the force index, its distribution and how far walls have come and since when they stall.
void add_force(std::vector<store::NamedMeasure>& results, const Model& model,
               const std::vector<double>& surface_at_start, const ForceRecord& record);

/// A line for each wall that wants to go on and cannot: since when, how far it has come, what
/// overlaps.
std::vector<std::string> stall_lines(const scene::Scene& scene, const Model& model,
                                     const std::vector<double>& surface_at_start);

}  // namespace clca::run
