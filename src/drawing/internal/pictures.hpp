#pragma once
// The pictures of a run while it is under way.

#include <memory>

#include "clca/scene/scene.hpp"
#include "record/internal/observer.hpp"

namespace clca::drawing {

/// Draws the frames that the scene requests, or the last one alone. Throws scene::SceneError if the
/// driver cannot draw them.
std::unique_ptr<record::Observer> pictures_observer(const scene::Scene& scene,
                                                    const grains::State& state, int threads,
                                                    bool only_last);

/// Memory that it takes at most, with its share of a checkpoint; 0 for a scene without frames.
double picture_bytes(const scene::Scene& scene, double particles);

}  // namespace clca::drawing
