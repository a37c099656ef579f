#include "clca/scene/resolve.hpp"

#include "scene/sections.hpp"

namespace clca::scene {

std::string to_yaml(const Scene& scene) {
  return block_text(scene_type().text(scene, scene));
}

std::string to_yaml(const BoltzmannScene& scene) {
  return block_text(boltzmann_type().text(scene, Scene()));
}

}  // namespace clca::scene
