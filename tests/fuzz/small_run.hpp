#pragma once
// A run with everything in it that a file of a run may hold, small enough to be read a thousand
// times a second: fallen, pushed and discharged particles, walls that come, go and overlap.

#include <vector>

#include "clca/scene/parse.hpp"
#include "run/stage.hpp"

namespace clca::fuzz {

inline const scene::Scene& small_scene() {
  static const scene::Scene kScene = scene::parse(R"(
clca: 1
box: {width: 16, height: 20}
species:
  grain: {shape: {hexagon: 1}}
  rod: {shape: {rod: {radius: 0, length: 3}}, orientations: any}
walls:
  gate: {box: [0, 3, 16, 4]}
  plate: {box: [2, 15, 12, 16], motion: {direction: down, period: 1, distance: 9}, passive: overlap}
outlets: {below: {region: [0, 0, 5, 3]}}
stages:
  - {name: packing, fill: {region: [0, 4, 16, 14], counts: {grain: 7, rod: 9}}, until: {steps: 8}}
  - {name: pushing, move: [plate], until: {steps: 12}}
  - {name: flow, remove: [gate], until: {steps: 12}}
)",
                                                  "small.yaml");
  return kScene;
}

struct SmallFrame {
  grains::State state;
  std::size_t stage = 0;
  bool stage_begins = false;
};

/// A state every few steps.
inline std::vector<SmallFrame> small_run() {
  constexpr std::uint64_t kEvery = 4;
  const scene::Scene& scene = small_scene();
  model::SceneModel model(scene, run::state_at_start(scene), {});
  std::vector<SmallFrame> frames;
  for (std::size_t stage = 0; stage < scene.stages.size(); ++stage) {
    run::prepare_stage(model, scene, stage);
    frames.push_back({model.state(), stage, true});
    const std::uint64_t steps = std::get<scene::UntilSteps>(scene.stages[stage].until).steps;
    for (std::uint64_t step = 1; step <= steps; ++step) {
      model.grains().step();
      if (step % kEvery == 0) {
        frames.push_back({model.state(), stage, false});
      }
    }
  }
  return frames;
}

}  // namespace clca::fuzz
