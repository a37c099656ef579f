#pragma once
// Parses YAML text into a tree of values; the only user of yaml-cpp.

#include <memory>
#include <string_view>

#include "scene/value.hpp"

namespace clca::scene {

/// Reads the single document in `text`. Stricter than YAML: no duplicate or compound keys, anchors,
/// aliases, merge keys, tags, directives or further documents.
/// Without a document the value is nothing. Throws SceneError.
Value read_document(std::string_view text, std::shared_ptr<const Origin> origin);

}  // namespace clca::scene
