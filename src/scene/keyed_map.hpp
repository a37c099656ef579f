#pragma once
// Values read strictly: of the right kind, in range, under a known key.

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "clca/text/message.hpp"
#include "scene/names.hpp"
#include "scene/value.hpp"

namespace clca::scene {

// Each takes the dotted path of the value, for the message.
std::uint64_t read_count(const Value& value, std::string_view path, std::uint64_t low,
                         std::uint64_t high);
int read_int(const Value& value, std::string_view path, int low, int high);
/// The number that the text is, as the format writes numbers; nothing for other text.
std::optional<double> to_number(std::string_view text);
double read_number(const Value& value, std::string_view path, double low, double high);
/// A number above 0 and up to `high`.
double read_positive(const Value& value, std::string_view path, double high);
bool read_bool(const Value& value, std::string_view path);
/// Any scalar as it stands.
const std::string& read_text(const Value& value, std::string_view path);
/// Number of characters of one line of UTF-8; none for other text.
std::optional<std::size_t> line_length(std::string_view text);
/// A list of `least` to `most` items.
const std::vector<Value>& read_list(const Value& value, std::string_view path, std::size_t least,
                                    std::size_t most);
/// A map; its keys are for the caller to check.
const std::vector<Entry>& read_map(const Value& value, std::string_view path);
/// A map from names that the scene gives to things; also checks the names.
const std::vector<Entry>& read_named(const Value& value, std::string_view path);
/// A name that the scene gives to something.
void check_name(const std::string& name, const TextLocation& location, std::string_view path);
/// The position of `name` in `names`, the `kind`s of the scene.
std::size_t read_reference(const std::string& name, const TextLocation& location,
                           std::string_view path, std::string_view kind,
                           std::span<const std::string_view> names);
/// The position of the scalar among `words`.
std::size_t read_word(const Value& value, std::string_view path,
                      std::span<const std::string_view> words);

template <class T, std::size_t kCount>
T read_choice(const Value& value, std::string_view path,
              const std::array<Named<T>, kCount>& names) {
  return names[read_word(value, path, words(names))].value;
}

using text::names_of;

/// True for the scalar `none`. Throws SceneError if it is no map either.
bool is_none(const Value& value, std::string_view path);
/// True for the word. Throws SceneError if it is no number either, which `phrase` describes.
bool is_word(const Value& value, std::string_view path, std::string_view word,
             std::string_view phrase);

/// `path.key`, or `key` alone at the top.
std::string join_path(std::string_view path, std::string_view key);

/// A map with known keys.
class KeyedMap {
 public:
  /// Throws SceneError when the value is no map or has a key that is not among `keys`.
  KeyedMap(const Value& map, std::string path, std::span<const std::string_view> keys);

  const Value* find(std::string_view key) const { return map_.find(key); }
  /// Throws SceneError when the key is missing.
  const Value& at(std::string_view key) const;
  /// The only one of `keys` that is there. Throws SceneError unless it is exactly one.
  std::string_view only(std::span<const std::string_view> keys) const;

  /// Refuses a key that only the other model has; does nothing if it is absent.
  void refuse_foreign(std::string_view key, Model owner) const;

  const TextLocation& location() const { return map_.location; }
  const std::string& path() const { return path_; }
  std::string path(std::string_view key) const { return join_path(path_, key); }

 private:
  const Value& map_;
  std::string path_;
};

}  // namespace clca::scene
