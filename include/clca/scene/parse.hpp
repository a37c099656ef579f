#pragma once
// Scene text to Scene: strict, every error with its place.

#include <cstddef>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "clca/scene/boltzmann.hpp"
#include "clca/scene/scene.hpp"

namespace clca::scene {

/// Something wrong in a scene. what() is one line: `FILE:LINE:COLUMN: error: MESSAGE`.
class SceneError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Most bytes that the text of a scene may have. A parser may take 250 times that in memory.
inline constexpr std::size_t kMostSceneBytes = std::size_t{4} << 20U;

/// A value to put in place of what the file says: `rules.inertia=0`, `stages.1.until.steps=50`
/// (list items by number from 0, or by `name` where they have one: `stages.flow.max_steps=9`).
/// The value is YAML. An error in it names `--set KEY=VALUE` as its place.
using Override = std::string;

/// A scene of grains, or one of the Boltzmann equation (a block `boltzmann`).
using AnyScene = std::variant<Scene, BoltzmannScene>;

/// Parses scene text. `file` names the place in messages and gives the scene its name. Overrides
/// that are `varied` come after the others; an error in one names `--vary KEY=VALUE`. Throws
/// SceneError.
AnyScene parse_any(std::string_view text, const std::string& file,
                   const std::vector<Override>& overrides = {},
                   const std::vector<Override>& varied = {});

/// Reads and parses a file. Throws SceneError, also when it cannot be read.
AnyScene parse_any_file(const std::filesystem::path& file,
                        const std::vector<Override>& overrides = {},
                        const std::vector<Override>& varied = {});

/// As parse_any and parse_any_file, for grains alone: the other kind is an error.
Scene parse(std::string_view text, const std::string& file,
            const std::vector<Override>& overrides = {}, const std::vector<Override>& varied = {});
Scene parse_file(const std::filesystem::path& file, const std::vector<Override>& overrides = {},
                 const std::vector<Override>& varied = {});

}  // namespace clca::scene
