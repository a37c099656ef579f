#include "clca/scene/resolve.hpp"

#include <memory>

#include "clca/text/message.hpp"
#include "scene/sections.hpp"
#include "scene/source_text.hpp"

namespace clca::scene {

std::string to_yaml(const Scene& scene) {
  return block_text(scene_type().text(scene, scene));
}

std::string to_yaml(const BoltzmannScene& scene) {
  return block_text(boltzmann_type().text(scene, Scene()));
}

void check_resolved(std::string_view yaml, std::string_view file) {
  const Origin origin = {text::printable(file) + ", with all defaults", true};
  const SourceText checked(yaml, std::make_shared<const Origin>(origin));
}

}  // namespace clca::scene
