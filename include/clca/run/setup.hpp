#pragma once
// The initial state of a scene.

#include "clca/grains/state.hpp"
#include "clca/scene/scene.hpp"

namespace clca::run {

/// The box with walls, closed sources and outlets, without particles. Equal orientations become one
/// kind.
/// Throws scene::SceneError if the walls cannot move as specified (see scene::check_walls).
grains::State initial_state(const scene::Scene& scene);

/// Notes the hash and the number of particles of the state that the scene begins with, if that is
/// another run's and they are not noted yet. Reads it within `max_bytes` of memory.
/// Throws scene::SceneError unless it is there, whole and the one that the scene asks for.
void find_begin(scene::Scene& scene, double max_bytes);

/// Checks that the names in derived measures are those of measures that the scene takes. Throws
/// scene::SceneError for the first that is not.
void check_derived(const scene::Scene& scene);

/// Does everything that a run does before its first step, without a folder, to check the scene.
/// Throws as run(). Takes as much memory and time.
void check_start(const scene::Scene& scene);

}  // namespace clca::run
