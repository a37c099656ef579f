#pragma once
// Scenes as text with every default filled in.

#include <string>
#include <string_view>

#include "clca/scene/boltzmann.hpp"
#include "clca/scene/scene.hpp"

namespace clca::scene {

/// YAML that parses to the same scene.
std::string to_yaml(const Scene& scene);
std::string to_yaml(const BoltzmannScene& scene);
/// A run saves that text, which `clca resume` reads. Throws SceneError where it is larger than a
/// scene may be; `file` is that of the scene.
void check_resolved(std::string_view yaml, std::string_view file);

/// What the model of a scene needs.
struct Size {
  int columns = 0;
  int rows = 0;
  std::uint64_t particles = 0;  ///< filled and emitted at the most
  double bytes = 0;             ///< estimated from above; run::memory_of() is that of a run
};

Size size_of(const Scene& scene);

/// Memory for the gases that a Boltzmann run keeps at its end so that the end can be moved: 0 if
/// more than 1 GiB, or without checkpoints.
double retained_gas_bytes(const BoltzmannScene& scene);

/// Upper estimate of the memory of a Boltzmann run on `threads` threads, in bytes.
double bytes_of(const BoltzmannScene& scene, int threads);

}  // namespace clca::scene
