#pragma once
// A Scene back to text, with every default filled in.

#include <string>

#include "clca/scene/scene.hpp"

namespace clca::scene {

/// YAML that parses to the same Scene.
std::string to_yaml(const Scene& scene);

/// What a scene will need.
struct Size {
  int columns = 0;
  int rows = 0;
  std::uint64_t particles = 0;  ///< filled and emitted at the most
  double bytes = 0;             ///< of memory, estimated from above
};

Size size_of(const Scene& scene);

}  // namespace clca::scene
