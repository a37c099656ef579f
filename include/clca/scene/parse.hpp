#pragma once
// Strict parsing of scene text; every error has a location.

#include <filesystem>
#include <string>
#include <string_view>
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
/// The value is YAML. Errors in it have `--set KEY=VALUE` as location.
using Override = std::string;

/// A scene of grains, or one of the Boltzmann equation (a block `boltzmann`).
using AnyScene = std::variant<Scene, BoltzmannScene>;

/// Parses scene text. `file` is used in messages and names the scene. `varied` overrides are
/// applied last; their errors name `--vary KEY=VALUE`. Throws SceneError.
AnyScene parse_any(std::string_view text, const std::string& file,
                   const std::vector<Override>& overrides = {},
                   const std::vector<Override>& varied = {});

/// The text of a scene. Throws SceneError if the file cannot be read.
std::string scene_text(const std::filesystem::path& file);

/// Reads and parses a file. Throws SceneError, also if it cannot be read.
AnyScene parse_any_file(const std::filesystem::path& file,
                        const std::vector<Override>& overrides = {},
                        const std::vector<Override>& varied = {});

/// As parse_any and parse_any_file, for scenes of grains only.
Scene parse(std::string_view text, const std::string& file,
            const std::vector<Override>& overrides = {}, const std::vector<Override>& varied = {});
Scene parse_file(const std::filesystem::path& file, const std::vector<Override>& overrides = {},
                 const std::vector<Override>& varied = {});

}  // namespace clca::scene
