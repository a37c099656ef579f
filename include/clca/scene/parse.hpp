#pragma once
// Scene text to Scene: strict, every error with its place.

#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "clca/scene/scene.hpp"

namespace clca::scene {

/// Something wrong in a scene. what() is one line: `FILE:LINE:COLUMN: error: MESSAGE`.
class SceneError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A value to put in place of what the file says: `rules.inertia=0`, `stages.1.until.steps=50`
/// (list items by number from 0, or by `name` where they have one: `stages.flow.max_steps=9`).
/// The value is YAML. An error in it names `--set KEY=VALUE` as its place.
using Override = std::string;

/// Parses scene text. `file` names the place in messages and gives the scene its name. Overrides
/// that are `varied` come after the others; an error in one names `--vary KEY=VALUE`. Throws
/// SceneError.
Scene parse(std::string_view text, const std::string& file,
            const std::vector<Override>& overrides = {}, const std::vector<Override>& varied = {});

/// Reads and parses a file. Throws SceneError, also when it cannot be read.
Scene parse_file(const std::filesystem::path& file, const std::vector<Override>& overrides = {},
                 const std::vector<Override>& varied = {});

}  // namespace clca::scene
