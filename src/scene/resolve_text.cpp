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

std::string point(const Eigen::Vector2d& location) {
  return fmt::format("[{}, {}]", location.x(), location.y());
}

std::string checkpoint_text(const std::optional<Checkpoints>& checkpoints) {
  if (!checkpoints) {
    return "none";
  }
  std::vector<std::string> parts;
  if (checkpoints->every) {
    parts.push_back(fmt::format("every: {}", *checkpoints->every));
  }
  if (checkpoints->seconds) {
    parts.push_back(fmt::format("seconds: {}", *checkpoints->seconds));
  }
  return fmt::format("{{{}}}", fmt::join(parts, ", "));
}

}  // namespace clca::scene
