#pragma once
// Keys at any depth.

#include <string>
#include <string_view>
#include <vector>

#include "scene/schema.hpp"

namespace clca::scene {

/// Paths of the keys of this name below `top`, the shortest first; `walls.NAME.motion` where a name
/// of the scene stands in between.
std::vector<std::string> paths_of_key(const Descriptions& top, std::string_view name);

/// Paths of the keys below `top` that say this word about themselves, the shortest first.
std::vector<std::string> paths_about(const Descriptions& top, std::string_view word);

/// `; did you mean 'rules.inertia'?` for a key of this or a similar name below `top`, or nothing.
std::string path_suggestion(const Descriptions& top, std::string_view name);

}  // namespace clca::scene
