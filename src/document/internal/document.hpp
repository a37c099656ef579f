#pragma once
// YAML as a tree of values with their text locations: parsed by the only user of yaml-cpp, with
// overrides of the command line and expressions, or to be written.

#include <fmt/format.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace clca::document {

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

struct Entry;

struct Value {
  enum class Kind { nothing, scalar, list, map };

  Kind kind = Kind::nothing;
  bool quoted = false;
  bool one_entry_per_line = false;  ///< to be written with each entry on a line of its own
  TextLocation location;
  std::string text;            ///< of a scalar; else empty
  std::string expression;      ///< whose value the text is; else empty
  std::vector<Value> items;    ///< of a list
  std::vector<Entry> entries;  ///< of a map, in the order of the text

  static Value scalar(std::string text, const TextLocation& location = {});
  static Value number(double number);
  /// A scalar in quotes: a title may hold anything that is one line.
  static Value quoted_text(std::string_view text);
  /// A name is plain, except for those that YAML takes for something else.
  static Value name(std::string_view name);
  static Value list();
  static Value map(const TextLocation& location = {});

  /// A further entry of a map; its key is where the value is.
  void add(std::string key, Value value);

  bool is(Kind other) const { return kind == other; }
  /// The value of `key`, null when there is none.
  const Value* find(std::string_view key) const;
  Value* find(std::string_view key);
  /// The value at a path of keys, likewise.
  const Value* find_path(std::string_view path) const;
};

struct Entry {
  std::string key;
  TextLocation location;
  Value value;
};

inline bool is_digit(char letter) {
  return letter >= '0' && letter <= '9';
}

/// The number that the text is; nothing for other text. For int, std::uint64_t and double.
template <class T>
std::optional<T> number_in(std::string_view text);
/// The same for a scalar without quotes; nothing for other values.
template <class T>
std::optional<T> number_in(const Value& value) {
  return value.quoted ? std::nullopt : number_in<T>(std::string_view(value.text));
}

/// `'text'`, `a list`, `a map` or `nothing`.
std::string found(const Value& value);

/// On one line: `{KEY: VALUE, KEY: [1, 2]}`.
std::string flow_text(const Value& value);
/// A map, an entry after the other; those that are too long for a line are divided.
std::string block_text(const Value& map);

/// The keys of a path, which dots separate.
std::vector<std::string> path_parts(std::string_view path);
/// `path.key`, or `key` alone at the top.
std::string join_path(std::string_view path, std::string_view key);

/// Throws Error: `FILE:LINE:COLUMN: error: MESSAGE`.
[[noreturn]] void throw_error(std::string_view location, std::string_view message);
template <class... Args>
[[noreturn]] void fail(const TextLocation& location, fmt::format_string<Args...> message,
                       Args&&... args) {
  throw_error(to_string(location), fmt::format(message, std::forward<Args>(args)...));
}

inline constexpr std::size_t kMaxNameLength = 64;

/// Throws Error unless the text is UTF-8 without control characters, tabs (comments may hold some),
/// byte order mark and YAML directives, not larger than kMaxBytes, not with more than 32 brackets
/// inside each other and not with more than 260,000 values.
void check_text(std::string_view text, std::shared_ptr<const Origin> origin);

/// Reads the single document in `text`. Stricter than YAML: no duplicate or compound keys, anchors,
/// aliases, merge keys, tags, directives or further documents.
/// Empty text gives a value of Kind::nothing. Throws Error.
Value read_document(std::string_view text, std::shared_ptr<const Origin> origin);

/// The value of an option, KEY=VALUE: as read_document(), without comments. Throws Error.
Value read_value(std::string_view text, const std::shared_ptr<const Origin>& origin);

/// Puts the value of `text` into the tree. In a map at a path that `is_choice`, which holds one key
/// out of several, a new key takes the place of the old one. `after_others`: refuse to replace what
/// an earlier option has set. Throws Error that names `OPTION KEY=VALUE`, or `given` if it has
/// text.
void apply_override(Value& root, const std::string& text, std::string_view option,
                    const std::string& given,
                    bool (*is_choice)(const std::vector<std::string>& path), bool after_others);

/// Evaluates what stands under `let`, in its order, then replaces each `=EXPRESSION` of the tree
/// by its value. Keys at the top: nothing under `let` has a `taken` name, under the key `text`
/// there are no expressions; those under the key `open` may have other names. Throws Error.
void evaluate_expressions(Value& root, const std::vector<std::string_view>& taken,
                          std::string_view text, std::string_view open);

/// Throws Error if the text of a value cannot be an expression, whatever its names stand for.
void check_expression(const Value& value);
/// The expression with numbers for the names that have one.
std::string with_names_replaced(
    std::string_view expression,
    const std::function<std::optional<double>(std::string_view name)>& number_of);
/// Whether names in expressions may be like this, of up to kMaxNameLength letters.
bool is_expression_name(const std::string& name);

}  // namespace clca::document
