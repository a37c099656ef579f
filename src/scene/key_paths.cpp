#include "scene/key_paths.hpp"

#include <fmt/format.h>

#include "clca/text/message.hpp"
#include "scene/key.hpp"

namespace clca::scene {

namespace {

struct PlacedKey {
  const KeyDescription* key = nullptr;
  std::string path;
};

/// All keys, the shortest paths first.
std::vector<PlacedKey> all_keys(const Descriptions& top) {
  std::vector<PlacedKey> all;
  const auto add = [&all](const Descriptions& keys, const std::string& above) {
    for (const KeyDescription& key : *keys) {
      all.push_back({&key, join_path(above, key.name)});
    }
  };
  add(top, "");
  std::size_t next = 0;
  while (next < all.size()) {
    const auto [key, path] = all[next++];
    if (key->keys != nullptr) {
      add(key->keys, key->is_collection ? path + ".NAME" : path);
    }
  }
  return all;
}

}  // namespace

std::vector<std::string> paths_of_key(const Descriptions& top, std::string_view name) {
  std::vector<std::string> paths;
  for (const auto& [key, path] : all_keys(top)) {
    if (key->name == name) {
      paths.push_back(path);
    }
  }
  return paths;
}

std::vector<std::string> paths_about(const Descriptions& top, std::string_view word) {
  const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  std::vector<std::string> paths;
  for (const auto& [key, path] : all_keys(top)) {
    const std::string about = fmt::format(" {} ", without_markup(key->about));
    for (std::size_t at = about.find(word); at != std::string::npos;
         at = about.find(word, at + 1)) {
      if (!is_letter(about[at - 1]) && !is_letter(about[at + word.size()])) {
        paths.push_back(path);
        break;
      }
    }
  }
  return paths;
}

std::string path_suggestion(const Descriptions& top, std::string_view name) {
  std::vector<std::string_view> names;
  for (const PlacedKey& placed : all_keys(top)) {
    names.push_back(placed.key->name);
  }
  const auto nearest = text::nearest(name, names);
  return nearest ? fmt::format("; did you mean '{}'?", paths_of_key(top, *nearest).front()) : "";
}

}  // namespace clca::scene
