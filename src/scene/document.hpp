#pragma once
// YAML text to a tree of values: the one place that knows yaml-cpp.

#include <memory>
#include <string_view>

#include "scene/value.hpp"

namespace clca::scene {

/// Reads the one document in `text`. Stricter than YAML: no duplicate or compound keys, anchors,
/// aliases, merge keys, tags, directives or further documents. Where there is no document the value
/// is nothing. Throws SceneError.
Value read_document(std::string_view text, std::shared_ptr<const Origin> origin);

}  // namespace clca::scene
