#pragma once
// Scenes played through with a trajectory, and all that a trajectory keeps of a state.

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "clca/run/setup.hpp"
#include "clca/scene/parse.hpp"
#include "clca/store/trajectory.hpp"
#include "run/stage.hpp"

namespace clca::testing {

/// A plate that enters particles, and a bed in a box.
inline scene::Scene plate_scene() {
  return scene::parse(
      "clca: 1\nseed: 5\nbox: {width: 40, height: 60}\n"
      "species: {small: {shape: {hexagon: 1}}, large: {shape: {hexagon: 2}}}\n"
      "walls: {plate: {box: [15, 40, 22, 60], passive: overlap,\n"
      "                motion: {direction: down, period: 2, distance: 30}}}\n"
      "stages:\n  - {name: packing, fill: {region: [0, 0, 40, 60], counts: {small: 40, large: "
      "40}},\n"
      "     until: {steps: 60}}\n"
      "  - {name: penetration, insert: [plate], move: [plate], until: {steps: 70}}\n",
      "plate.yaml");
}

/// Particles enter, are shaken, slide across a periodic seam and leave.
inline scene::Scene hourglass_scene() {
  return scene::parse(
      "clca: 1\nseed: 9\nbox: {width: 30, height: 50, periodic: true}\n"
      "species:\n  grain: {shape: {hexagon: 1}}\n"
      "  rod: {shape: {rod: {radius: 0, length: 4}}, orientations: any}\n"
      "rules: {scatter: 0.5}\n"
      "walls:\n  floor: {box: [0, 8, 20, 9], motion: {direction: up, shake: {amplitude: 2, wait: "
      "3}}}\n"
      "  gate: {box: [24, 0, 25, 12]}\n"
      "sources: {spout: {region: [2, 46, 12, 48], species: {grain: 1, rod: 1}, rate: 0.5}}\n"
      "outlets: {drain: {region: [0, 0, 40, 4]}}\n"
      "stages:\n  - {name: pouring, sources: [spout], until: {steps: 80}}\n"
      "  - {name: shaking, remove: [gate], move: [floor], sources: [spout], until: {steps: 90}}\n",
      "hourglass.yaml");
}

/// What a trajectory keeps of `state`, a state of the scene that begins as `fixed`.
inline grains::State kept_of(const grains::State& state, const grains::State& fixed) {
  grains::State kept = state;
  for (std::size_t id = 0; id < kept.particles.size(); ++id) {
    if (!kept.particles[id].present) {
      kept.particles[id] = {.present = false};
      kept.origins[id] = {};
    }
  }
  for (grains::Wall& wall : kept.walls) {
    wall.travel = {.offset = wall.travel.offset};
  }
  kept.sources = fixed.sources;
  kept.outlets = fixed.outlets;
  return kept;
}

/// Goes through all stages, which end after some steps, with a frame every `every` of them, at
/// their begin and end. `take(state, stage, begins)` gets each.
inline void play(const scene::Scene& scene, std::uint64_t every,
                 const std::function<void(const grains::State&, std::size_t, bool)>& take) {
  model::SceneModel model(scene, run::state_at_start(scene), {});
  for (std::size_t stage = 0; stage < scene.stages.size(); ++stage) {
    run::prepare_stage(model, scene, stage);
    take(model.state(), stage, true);
    const std::uint64_t steps = std::get<scene::UntilSteps>(scene.stages[stage].until).steps;
    for (std::uint64_t step = 1; step <= steps; ++step) {
      model.grains().step();
      if (step % every == 0 || step == steps) {
        take(model.state(), stage, false);
      }
    }
  }
}

}  // namespace clca::testing
