#pragma once
// The particles of another run, with which a run begins.

#include "clca/scene/scene.hpp"
#include "run/model.hpp"

namespace clca::run {

/// Puts the particles of the state that the scene begins with into `state`, which has none yet.
/// They are numbered anew, in their order. Grains of the contact model keep velocities, contacts
/// and positions within their sites if they come from the end of a run of that model, else they are
/// at rest. Throws scene::SceneError, also if they are of other species or find no room.
void take_particles(const scene::Scene& scene, ModelState& state);

}  // namespace clca::run
