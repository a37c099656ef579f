#pragma once
// Values as the text of a scene.

#include <optional>
#include <string>
#include <string_view>

#include "clca/scene/scene.hpp"

namespace clca::scene {

/// In quotes: a title may hold anything that is one line.
std::string quoted(std::string_view text);

/// Names are plain, but for the few that YAML takes for something else.
std::string name(std::string_view text);

std::string rectangle(const lattice::Rectangle& edges);
std::string point(const Eigen::Vector2d& location);

/// `  NAME: {...}` and a line end.
std::string wall_line(const Wall& wall);

/// `contact:` and a line for each key.
std::string contact_block(const contact::Parameters& contact);

/// `units: {...}` and a line end.
std::string units_line(const Units& units);

/// `open`, the texts of the items with commas between, `close`.
template <class Items, class Text>
std::string enclosed(char open, const Items& items, char close, Text text) {
  std::string result(1, open);
  for (const auto& item : items) {
    result += result.size() > 1 ? ", " : "";
    result += text(item);
  }
  return result + close;
}

template <class Items, class Text>
std::string list(const Items& items, Text text) {
  return enclosed('[', items, ']', text);
}

/// As the value of `output.checkpoint`.
std::string checkpoint_text(const std::optional<Checkpoints>& checkpoints);

}  // namespace clca::scene
