#pragma once
// A Scene back to text, with every default filled in.

#include <string>

#include "clca/scene/boltzmann.hpp"
#include "clca/scene/scene.hpp"

namespace clca::scene {

/// YAML that parses to the same Scene.
std::string to_yaml(const Scene& scene);
std::string to_yaml(const BoltzmannScene& scene);

/// What a scene will need.
struct Size {
  int columns = 0;
  int rows = 0;
  std::uint64_t particles = 0;  ///< filled and emitted at the most
  double bytes = 0;             ///< of memory, estimated from above
};

Size size_of(const Scene& scene);

/// Memory of the gases that a Boltzmann run keeps as they were at its end, so that the end can be
/// moved: 0 where that would be more than 1 GiB, or the scene has no checkpoints.
double lasting_bytes(const BoltzmannScene& scene);

/// Memory of a Boltzmann run on that many threads, in bytes, estimated from above.
double bytes_of(const BoltzmannScene& scene, int threads);

}  // namespace clca::scene
