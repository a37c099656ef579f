#pragma once
// A value of the text of a scene, and where it is.

#include <fmt/format.h>

#include <string>
#include <string_view>
#include <utility>

#include "document/internal/value.hpp"

namespace clca::scene {

using document::Entry;
using document::fail;
using document::flow_text;
using document::found;
using document::join_path;
using document::TextLocation;
using document::throw_error;
using document::Value;

struct Scene;

/// A value that is read.
struct Place {
  const Value& value;
  std::string path;    ///< dotted, for messages; empty at the top
  const Scene& scene;  ///< as far as it has been read

  /// The value of a key; null where it is not given.
  const Value* find(std::string_view key) const { return value.find(key); }
  /// Refuses a map without the key.
  Place at(std::string_view key) const;
  /// The value of an entry.
  Place inside(const Entry& entry) const;
};

inline std::string found(const Place& place) {
  return found(place.value);
}

/// Throws SceneError with the path of the value in front of the message.
template <class... Args>
[[noreturn]] void fail(const Place& place, fmt::format_string<Args...> message, Args&&... args) {
  fail(place.value.location, "{}: {}", place.path.empty() ? "scene" : place.path,
       fmt::format(message, std::forward<Args>(args)...));
}

}  // namespace clca::scene
