#pragma once
// `--set KEY=VALUE`: a value of the command line in place of what the file says.

#include <string>
#include <string_view>

#include "scene/value.hpp"

namespace clca::scene {

/// Puts the value of `text` into the tree. Throws SceneError that names `OPTION KEY=VALUE`.
void apply_override(Value& root, const std::string& text, std::string_view option);

}  // namespace clca::scene
