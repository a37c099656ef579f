#pragma once
// Strict parsing of scene text, in which every error has a location; the text of a scene with every
// default filled in; the memory that its run takes.

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "clca/document/document.hpp"
#include "clca/scene/boltzmann.hpp"
#include "clca/scene/scene.hpp"

namespace clca::scene {

/// An error in a scene.
using SceneError = document::Error;

/// Replaces a value of the file: `rules.inertia=0`, `stages.1.until.steps=50` (list items by number
/// from 0, or by `name`: `stages.flow.max_steps=9`).
/// The value is YAML. Errors in it have the `option` as location; without one, `--set KEY=VALUE`.
struct Override {
  // NOLINTBEGIN(google-explicit-constructor): mostly it is its text.
  Override(std::string key_and_value, std::string given_as = "")
      : text(std::move(key_and_value)), option(std::move(given_as)) {}
  Override(const char* key_and_value) : text(key_and_value) {}
  // NOLINTEND(google-explicit-constructor)

  std::string text;
  std::string option;  ///< as it was given
};

/// A scene of grains, or one of the Boltzmann equation (a block `boltzmann`).
using AnyScene = std::variant<Scene, BoltzmannScene>;

/// Parses scene text. `file` is used in messages and names the scene. `varied` overrides are
/// applied last; their errors name `--vary KEY=VALUE`. Throws SceneError.
AnyScene parse_any(std::string_view text, const std::string& file,
                   const std::vector<Override>& overrides = {},
                   const std::vector<Override>& varied = {});

/// The text of a scene. Throws SceneError if the file cannot be read.
std::string read_scene_text(const std::filesystem::path& file);

/// Reads and parses a file. Throws SceneError, also if it cannot be read.
AnyScene parse_any_file(const std::filesystem::path& file,
                        const std::vector<Override>& overrides = {});

/// As parse_any and parse_any_file, for scenes of grains only.
Scene parse(std::string_view text, const std::string& file,
            const std::vector<Override>& overrides = {});
Scene parse_file(const std::filesystem::path& file, const std::vector<Override>& overrides = {});

/// YAML that parses to the same scene.
std::string to_yaml(const Scene& scene);
std::string to_yaml(const BoltzmannScene& scene);
/// Throws SceneError if this text, which `clca resume` would read, is larger than a scene may be.
void check_resolved_size(std::string_view yaml, std::string_view file);

/// ModelSize of the model of a scene.
struct ModelSize {
  int columns = 0;
  int rows = 0;
  std::uint64_t max_particles = 0;  ///< filled and emitted at most
  double memory_bytes = 0;  ///< estimated from above; run::estimated_run_bytes() is that of a run
};

ModelSize model_size(const Scene& scene);

/// Memory in bytes for the final gases that a Boltzmann run keeps, so that it can be continued: 0
/// if more than 1 GiB, or without checkpoints.
double retained_gas_bytes(const BoltzmannScene& scene);

/// Upper estimate of the memory of a Boltzmann run on `threads` threads, in bytes.
double gas_run_bytes(const BoltzmannScene& scene, int threads);

}  // namespace clca::scene
