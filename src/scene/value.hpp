#pragma once
// YAML text as a tree in which everything knows its place.

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace clca::scene {

/// Where text comes from: a file, or a `--set` of the command line.
struct Origin {
  std::string label;  ///< printable
  bool has_lines = true;
};

/// Lines and columns from 1; columns count characters.
struct Place {
  std::shared_ptr<const Origin> origin;
  std::size_t line = 1;
  std::size_t column = 1;
};

/// `FILE:LINE:COLUMN`, or `--set KEY=VALUE`.
std::string to_string(const Place& place);

/// Throws SceneError: `FILE:LINE:COLUMN: error: MESSAGE`.
[[noreturn]] void fail(const Place& place, std::string_view message);

struct Entry;

struct Value {
  enum class Kind { nothing, scalar, list, map };

  Kind kind = Kind::nothing;
  bool quoted = false;
  Place place;
  std::string text;            ///< of a scalar
  std::vector<Value> items;    ///< of a list
  std::vector<Entry> entries;  ///< of a map, in the order of the text

  bool is(Kind other) const { return kind == other; }
  /// The value of `key`, null when there is none.
  const Value* find(std::string_view key) const;
  Value* find(std::string_view key);
};

struct Entry {
  std::string key;
  Place place;
  Value value;
};

/// `'text'`, `a list`, `a map` or `nothing`.
std::string found(const Value& value);

}  // namespace clca::scene
