#include "clca/scene/boltzmann.hpp"

#include <tuple>

namespace clca::scene {

namespace {

/// What counts when two are compared: everything but the name of the file and the place in it.
auto content(const BoltzmannScene& scene) {
  return std::tie(scene.title, scene.seed, scene.particles, scene.initial, scene.exact_moments,
                  scene.quasi, scene.restitutions, scene.lists_restitutions, scene.friction,
                  scene.roughness, scene.energy_ratio, scene.scheme, scene.shear_rate, scene.until,
                  scene.ensemble, scene.series_every, scene.histograms, scene.bins,
                  scene.checkpoint);
}

}  // namespace

bool BoltzmannScene::operator==(const BoltzmannScene& other) const {
  return content(*this) == content(other);
}

}  // namespace clca::scene
