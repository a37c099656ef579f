#pragma once
// YAML as a tree of values with their text locations.

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace clca::scene {

/// Source of text: a file, or a `--set` option.
struct Origin {
  std::string label;  ///< printable
  bool has_lines = true;
};

/// Lines and columns from 1; columns count characters.
struct TextLocation {
  std::shared_ptr<const Origin> origin;
  std::size_t line = 1;
  std::size_t column = 1;
};

/// `FILE:LINE:COLUMN`, or `--set KEY=VALUE`.
std::string to_string(const TextLocation& location);

/// Throws SceneError: `FILE:LINE:COLUMN: error: MESSAGE`.
[[noreturn]] void fail(const TextLocation& location, std::string_view message);

struct Entry;
struct PictureFile;

struct Value {
  enum class Kind { nothing, scalar, list, map };

  Kind kind = Kind::nothing;
  bool quoted = false;
  TextLocation location;
  std::string text;        ///< of a scalar
  std::string expression;  ///< that the text is the value of; empty if it was written so
  std::shared_ptr<const PictureFile> picture;  ///< of a scalar that names one
  std::vector<Value> items;                    ///< of a list
  std::vector<Entry> entries;                  ///< of a map, in the order of the text

  bool is(Kind other) const { return kind == other; }
  /// The value of `key`, null when there is none.
  const Value* find(std::string_view key) const;
  Value* find(std::string_view key);
};

/// A scalar as if it were written there, and a map without entries.
Value scalar_at(const TextLocation& location, const std::string& text);
Value map_at(const TextLocation& location);

struct Entry {
  std::string key;
  TextLocation location;
  Value value;
};

/// `'text'`, `a list`, `a map` or `nothing`.
std::string found(const Value& value);

}  // namespace clca::scene
