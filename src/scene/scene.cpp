#include "clca/scene/scene.hpp"

#include <algorithm>

#include "clca/scene/boltzmann.hpp"

namespace clca::scene {

std::optional<std::uint64_t> fixed_steps(const EndCondition& until) {
  if (const auto* time = std::get_if<UntilTime>(&until)) {
    return time->steps;
  }
  const auto* steps = std::get_if<UntilSteps>(&until);
  return steps != nullptr ? std::optional(steps->steps) : std::nullopt;
}

int step_digits(const Scene& scene) {
  std::uint64_t last = 0;
  for (const Stage& stage : scene.stages) {
    const std::uint64_t bound = stage.max_steps > Stage().max_steps ? stage.max_steps : 0;
    last += fixed_steps(stage.until).value_or(bound);
  }
  return std::max(6, static_cast<int>(std::to_string(last).size()));
}

bool vessel_has_cycles(const Stage& stage) {
  return stage.vessel_motion && !std::holds_alternative<Tilt>(*stage.vessel_motion);
}

bool pictures_show_forces(const Scene& scene) {
  const auto& frames = scene.output.frames;
  return scene.model == Model::contact && frames &&
         (frames->overlay == Overlay::forces || frames->color_by == ColorBy::force ||
          frames->color_by == ColorBy::pressure);
}

bool shows_weight_paths(Overlay overlay) {
  return overlay == Overlay::weight_inner || overlay == Overlay::weight_outer ||
         overlay == Overlay::weight_pair || overlay == Overlay::weight_q;
}

bool pictures_compare_positions(const Scene& scene) {
  const auto& frames = scene.output.frames;
  return frames && (frames->overlay == Overlay::velocity ||
                    (frames->color_by == ColorBy::speed && scene.model != Model::contact));
}

std::vector<int> orientation_degrees(const Scene& scene, const std::vector<grains::Kind>& kinds) {
  std::vector<int> result;
  for (const grains::Kind& kind : kinds) {
    const Species& species = scene.species[kind.species];
    if (scene.model == Model::baxter) {
      result.push_back(kOrientationStep * static_cast<int>(result.size() % baxter::kAxisCount));
      continue;
    }
    const auto found = std::ranges::find_if(species.orientations, [&](int degrees) {
      return species.shape.rotated(degrees / kOrientationStep).is_congruent(kind.shape);
    });
    result.push_back(found != species.orientations.end() ? *found : 0);
  }
  return result;
}

boltzmann::InitialCondition initial_condition(const BoltzmannScene& scene) {
  return {.particle_count = scene.particles,
          .distribution = scene.initial,
          .energy_ratio = scene.energy_ratio,
          .exact_moments = scene.exact_moments,
          .quasi_random = scene.quasi_random};
}

boltzmann::Dynamics gas_process(const BoltzmannScene& scene, double restitution) {
  return {
      .law = {.restitution = restitution, .friction = scene.friction, .roughness = scene.roughness},
      .scheme = scene.scheme,
      .shear_rate = scene.shear_rate};
}

}  // namespace clca::scene
