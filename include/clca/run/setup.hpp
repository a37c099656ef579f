#pragma once
// From a scene to the state it starts in.

#include "clca/grains/state.hpp"
#include "clca/scene/scene.hpp"

namespace clca::run {

/// The box with its walls, sources (closed) and outlets; no particles yet. Orientations that look
/// alike become one kind. Throws scene::SceneError when the walls cannot move as they should (see
/// scene::check_walls).
grains::State initial_state(const scene::Scene& scene);

/// Carries out what a run does before its first step, without a folder, to find out whether it
/// would refuse the scene: throws as run() does then. Takes the memory of the run and its time to
/// the first step.
void check_beginning(const scene::Scene& scene);

}  // namespace clca::run
