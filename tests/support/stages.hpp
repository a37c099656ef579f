#pragma once
// Stages begun as a run begins them.

#include <utility>

#include "run/stage.hpp"

namespace clca::testing {

/// The state with a stage of the scene, of the automaton, begun.
inline grains::State stage_begun(const scene::Scene& scene, std::size_t stage,
                                 grains::State state) {
  model::SceneModel model(scene, std::move(state), {});
  run::prepare_stage(model, scene, stage);
  return model.state();
}

}  // namespace clca::testing
