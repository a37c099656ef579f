#pragma once
// Values read strictly: of the right kind, in range, under a known key.

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "clca/text/message.hpp"
#include "document/internal/number.hpp"
#include "scene/names.hpp"
#include "scene/place.hpp"

namespace clca::scene {

using document::is_digit;
using document::number_in;

// All throw SceneError.
std::uint64_t read_count(const Place& place, std::uint64_t low, std::uint64_t high);
int read_int(const Place& place, int low, int high);
double read_number(const Place& place, double low, double high);
/// A number above 0 and up to `high`.
double read_positive(const Place& place, double high);
bool read_bool(const Place& place);
/// Any scalar as it stands.
const std::string& read_text(const Place& place);
/// Number of characters of one line of UTF-8; none for other text.
std::optional<std::size_t> line_length(std::string_view text);
/// A list of `least` to `most` items, each with the path of the list. Where `read_item` takes the
/// word that stands in the place of the list, the message says how to write it.
std::vector<Place> read_list(const Place& place, std::size_t least, std::size_t most,
                             const std::function<void(const Place& item)>& read_item = nullptr);
/// A map; its keys are for the caller to check.
const std::vector<Entry>& read_map(const Place& place);
/// A map from names that the scene gives to things; also checks the names.
const std::vector<Entry>& read_named(const Place& place);
/// A name that the scene gives to something.
void check_name(const std::string& name, const TextLocation& location, std::string_view path);
/// The position of `name` in `names`, the `kind`s of the scene.
std::size_t read_reference(const std::string& name, const TextLocation& location,
                           std::string_view path, std::string_view kind,
                           std::span<const std::string_view> names);
/// The position of the scalar among `words`.
std::size_t read_word(const Place& place, std::span<const std::string_view> words);

template <class T, std::size_t kCount>
T read_choice(const Place& place, const std::array<Named<T>, kCount>& names) {
  return names[read_word(place, words(names))].value;
}

using text::names_of;

/// True for the scalar `none`. Refuses what is no map either.
bool is_none(const Place& place);
/// True for the word. Refuses what is no number either, which `phrase` describes.
bool is_word(const Place& place, std::string_view word, std::string_view phrase);

/// Where a value is, for messages about the scene once it has been read.
std::string reference(const Place& place);

/// A map with known keys.
struct KeyedMap : Place {
  /// Refuses what is no map, or has a key that is not among `keys`.
  KeyedMap(const Place& map, std::span<const std::string_view> keys);

  /// The only one of `keys` that is there. Refuses a map unless it has exactly one.
  std::string_view only(std::span<const std::string_view> keys) const;
};

}  // namespace clca::scene
