#pragma once
// Values of the text of a scene with their places, read strictly: right kind, range and key.

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "clca/text/message.hpp"
#include "document/internal/document.hpp"
#include "scene/names.hpp"

namespace clca::scene {

using document::Entry;
using document::fail;
using document::flow_text;
using document::found;
using document::is_digit;
using document::join_path;
using document::number_in;
using document::TextLocation;
using document::throw_error;
using document::Value;
using text::names_of;

/// Largest number of species, walls, parts of a wall, sources, outlets and stages, each.
inline constexpr std::size_t kMaxItems = 1000;

/// A value of the text of a scene while it is read, with its path.
struct PlacedValue {
  const Value& value;
  std::string path;    ///< dotted, for messages; empty at the top
  const Scene& scene;  ///< as far as it has been read

  /// The value of a key; null where it is not given.
  const Value* find(std::string_view key) const { return value.find(key); }
  /// The value of a key. Refuses a map without it.
  PlacedValue at(std::string_view key) const;
  /// The value of an entry.
  PlacedValue at(const Entry& entry) const;
  /// The only one of `keys` that is there. Refuses a map unless it has exactly one.
  std::string_view only_key(std::span<const std::string_view> keys) const;
};

inline std::string found(const PlacedValue& place) {
  return found(place.value);
}

/// Throws SceneError with the path of the value in front of the message.
template <class... Args>
[[noreturn]] void fail(const PlacedValue& place, fmt::format_string<Args...> message,
                       Args&&... args) {
  fail(place.value.location, "{}: {}", place.path.empty() ? "scene" : place.path,
       fmt::format(message, std::forward<Args>(args)...));
}

// All throw SceneError.

/// A number of type int, std::uint64_t or double.
template <class T>
T read_number(const PlacedValue& place, T low, T high);
/// Throws: expected `allowed`, found the value.
[[noreturn]] void throw_unexpected(const PlacedValue& place, std::string_view allowed);
/// Any scalar as it stands.
const std::string& read_text(const PlacedValue& place);
/// Number of characters of one line of UTF-8; none for other text.
std::optional<std::size_t> line_length(std::string_view text);
/// A list of `least` to `most` items, each with the path of the list. Where `read_item` takes the
/// word that stands in the place of the list, the message says how to write it.
std::vector<PlacedValue> read_list(
    const PlacedValue& place, std::size_t least, std::size_t most,
    const std::function<void(const PlacedValue& item)>& read_item = nullptr);
/// Refuses what is no map, or has a key that is not among `keys`.
void check_keys(const PlacedValue& map, std::span<const std::string_view> keys);
/// A map; its keys are for the caller to check.
const std::vector<Entry>& read_map(const PlacedValue& place);
/// A map from names that the scene gives to things; also checks the names.
const std::vector<Entry>& read_named(const PlacedValue& place);
/// A name that the scene gives to something.
void check_name(const std::string& name, const TextLocation& location, std::string_view path);
/// The position of the name among `names`, the `kind`s of the scene.
std::size_t read_reference(const PlacedValue& place, std::string_view kind,
                           std::span<const std::string_view> names);
/// The position of the scalar among `words`.
std::size_t read_word(const PlacedValue& place, std::span<const std::string_view> words);

/// True for the scalar `none`. Refuses what is no map either.
bool is_none(const PlacedValue& place);
/// True for the word. Refuses what is no number either, which `phrase` describes.
bool is_word(const PlacedValue& place, std::string_view word, std::string_view phrase);

/// Where a value is, for messages about the scene once it has been read.
std::string location_text(const PlacedValue& place);

}  // namespace clca::scene
