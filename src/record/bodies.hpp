#pragma once
// Which way walls and sides of the box lie; see body_name() and walls_and_sides() for their names.

#include <Eigen/Core>
#include <optional>

#include "clca/grains/state.hpp"
#include "clca/scene/scene.hpp"

namespace clca::record {

/// A unit vector along a wall whose parts are all parallel, or a side of the box: towards its lower
/// end, or to the right. None for other walls.
std::optional<Eigen::Vector2d> direction_of(const scene::Scene& scene, grains::Owner body);

}  // namespace clca::record
