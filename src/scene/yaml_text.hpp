#pragma once
// A tree of values as YAML text.

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace clca::scene {

using Json = nlohmann::ordered_json;

struct YamlEntry;

struct Yaml {
  enum class Kind { scalar, list, map };

  Kind kind = Kind::scalar;
  std::string text;                ///< of a scalar, as it stands in the file
  std::vector<Yaml> items;         ///< of a list
  std::vector<YamlEntry> entries;  ///< of a map
  bool in_lines = false;           ///< each entry on a line of its own

  static Yaml scalar(std::string text);
  static Yaml list(std::vector<Yaml> items);
  static Yaml map(std::vector<YamlEntry> entries);
  static Yaml number(double number);
};

struct YamlEntry {
  std::string key;
  Yaml value;
};

/// A scalar in quotes: a title may hold anything that is one line.
Yaml quoted_text(std::string_view text);
/// A name is plain, except for those that YAML takes for something else.
Yaml name_text(std::string_view name);

/// On one line: `{KEY: VALUE, KEY: [1, 2]}`.
std::string flow_text(const Yaml& value);
/// A map, an entry after the other; those that are too long for a line are divided.
std::string block_text(const Yaml& map);

/// Plain scalars become numbers, booleans or strings.
Json to_json(const Yaml& value);

}  // namespace clca::scene
