#include "clca/scene/boltzmann.hpp"

namespace clca::scene {

boltzmann::InitialCondition initial_condition(const BoltzmannScene& scene) {
  return {.particles = scene.particles,
          .initial = scene.initial,
          .energy_ratio = scene.energy_ratio,
          .exact_moments = scene.exact_moments,
          .quasi = scene.quasi};
}

boltzmann::Process process(const BoltzmannScene& scene, double restitution) {
  return {
      .law = {.restitution = restitution, .friction = scene.friction, .roughness = scene.roughness},
      .scheme = scene.scheme,
      .shear_rate = scene.shear_rate};
}

}  // namespace clca::scene
