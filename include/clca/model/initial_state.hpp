#pragma once
// The state that a scene of grains begins with.

#include "clca/grains/state.hpp"
#include "clca/scene/scene.hpp"

namespace clca::model {

/// The box with walls, closed sources and outlets, without particles. Equal orientations become one
/// kind.
/// Throws scene::SceneError if the walls cannot move as specified (see scene::check_walls).
grains::State initial_state(const scene::Scene& scene);

}  // namespace clca::model
