#include "scene/resolve_text.hpp"

#include <fmt/format.h>

namespace clca::scene {

std::string quoted(std::string_view text) {
  std::string result = "\"";
  for (const char letter : text) {
    if (letter == '"' || letter == '\\') {
      result += '\\';
    }
    result += letter;
  }
  return result + "\"";
}

std::string name(std::string_view text) {
  const bool special = text.starts_with('-') || text == "null" || text == "Null" || text == "NULL";
  return special ? quoted(text) : std::string(text);
}

std::string rectangle(const lattice::Rectangle& edges) {
  return fmt::format("[{}, {}, {}, {}]", edges.left, edges.bottom, edges.right, edges.top);
}

std::string point(const Eigen::Vector2d& place) {
  return fmt::format("[{}, {}]", place.x(), place.y());
}

}  // namespace clca::scene
