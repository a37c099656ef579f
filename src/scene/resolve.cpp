#include "clca/scene/resolve.hpp"

#include "scene/sections.hpp"

namespace clca::scene {

std::string to_yaml(const Scene& scene) {
  return block_text(text_of(scene_map().keys, scene, scene));
}

std::string to_yaml(const BoltzmannScene& scene) {
  return block_text(text_of(boltzmann_map().keys, scene, Scene()));
}

}  // namespace clca::scene
