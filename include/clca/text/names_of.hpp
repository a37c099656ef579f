#pragma once

#include <string_view>
#include <vector>

namespace clca::text {

/// The names of things that have one. `Text` is std::string_view (into the things) or std::string.
template <class Text = std::string_view, class Things>
std::vector<Text> names_of(const Things& things) {
  std::vector<Text> names;
  for (const auto& thing : things) {
    names.emplace_back(thing.name);
  }
  return names;
}

}  // namespace clca::text
