#include "scene/place.hpp"

#include <algorithm>
#include <regex>

#include "clca/scene/parse.hpp"
#include "clca/text/utf8.hpp"
#include "scene/sections.hpp"
#include "scene/types.hpp"

namespace clca::scene {

namespace {

/// The nearest of the keys or, at the top and on a command line, a key elsewhere.
std::string suggestion(const Entry& entry, std::string_view path,
                       std::span<const std::string_view> keys) {
  constexpr std::string_view kGas = "boltzmann";
  const bool is_gas = path.starts_with(kGas) || std::ranges::find(keys, kGas) != keys.end();
  const AnyKeys& all = is_gas ? boltzmann_type().keys : scene_type().keys;
  const bool elsewhere = path.empty() || !entry.location.origin->has_lines;
  const bool is_elsewhere = elsewhere && !paths_of_key(all, entry.key).empty();
  std::string here = is_elsewhere ? "" : text::suggestion(entry.key, keys);
  return here.empty() && (path.empty() || is_elsewhere) ? path_suggestion(all, entry.key) : here;
}

bool accepts(const std::function<void(const PlacedValue& place)>& read, const PlacedValue& place) {
  try {
    read(place);
    return true;
  } catch (const SceneError&) {
    return false;
  }
}

}  // namespace

void throw_unexpected(const PlacedValue& place, std::string_view allowed) {
  fail(place, "expected {}, found {}", allowed, found(place));
}

template <class T>
T read_number(const PlacedValue& place, T low, T high) {
  const auto number = number_in<T>(place.value);
  if (!number || *number < low || *number > high) {
    throw_unexpected(
        place, fmt::format("a {} from {} to {}", std::is_integral_v<T> ? "whole number" : "number",
                           low, high));
  }
  return *number;
}

template int read_number(const PlacedValue& place, int low, int high);
template std::uint64_t read_number(const PlacedValue& place, std::uint64_t low, std::uint64_t high);
template double read_number(const PlacedValue& place, double low, double high);

const std::string& read_text(const PlacedValue& place) {
  if (!place.value.is(Value::Kind::scalar)) {
    throw_unexpected(place, "text");
  }
  return place.value.text;
}

std::optional<std::size_t> line_length(std::string_view text) {
  std::size_t characters = 0;
  for (std::size_t i = 0; i < text.size(); ++characters) {
    const std::size_t length = text::character_bytes(text, i);
    if (length == 0 || text::is_control_character(text::character_at(text, i))) {
      return std::nullopt;
    }
    i += length;
  }
  return characters;
}

std::vector<PlacedValue> read_list(const PlacedValue& place, std::size_t least, std::size_t most,
                                   const std::function<void(const PlacedValue& item)>& read_item) {
  const Value& value = place.value;
  if (!value.is(Value::Kind::list)) {
    const bool may_be_item = value.is(Value::Kind::scalar) && !value.quoted && least <= 1 &&
                             read_item && accepts(read_item, place);
    fail(place, "expected a list, found {}{}", found(value),
         may_be_item ? fmt::format("; write [{}]", text::shortened(value.text)) : "");
  }
  const std::size_t size = value.items.size();
  if (size < least || size > most) {
    const std::string range =
        least == most ? std::to_string(least) : fmt::format("{} to {}", least, most);
    fail(place, "expected {} items, found {}", range, size);
  }
  std::vector<PlacedValue> items;
  for (const Value& item : value.items) {
    items.push_back({item, place.path, place.scene});
  }
  return items;
}

const std::vector<Entry>& read_map(const PlacedValue& place) {
  if (!place.value.is(Value::Kind::map)) {
    throw_unexpected(place, "a map");
  }
  return place.value.entries;
}

const std::vector<Entry>& read_named(const PlacedValue& place) {
  const std::vector<Entry>& entries = read_map(place);
  if (entries.size() > kMaxItems) {
    fail(place, "expected at most {}, found {}", kMaxItems, entries.size());
  }
  for (const Entry& entry : entries) {
    check_name(entry.key, entry.location, place.path);
  }
  return entries;
}

void check_name(const std::string& name, const TextLocation& location, std::string_view path) {
  static const std::regex kPattern(kNamePattern);
  if (!std::regex_match(name, kPattern)) {
    fail(location, "{}: a name has 1 to {} of the characters A-Z a-z 0-9 _ -, found {}", path,
         document::kMaxNameLength, text::quoted(name));
  }
}

std::size_t read_reference(const PlacedValue& place, std::string_view kind,
                           std::span<const std::string_view> names) {
  const std::string& name = read_text(place);
  const auto match = std::ranges::find(names, name);
  if (match == names.end()) {
    const std::string known =
        names.empty() ? "there is none" : "known: " + text::comma_separated(names);
    fail(place, "unknown {} {} ({}){}", kind, text::quoted(name), known,
         text::suggestion(name, names));
  }
  return static_cast<std::size_t>(match - names.begin());
}

std::size_t read_word(const PlacedValue& place, std::span<const std::string_view> words) {
  const Value& value = place.value;
  const auto match = std::ranges::find(words, value.text);
  if (match == words.end()) {
    fail(place, "expected one of {}, found {}{}", fmt::join(words, ", "), found(value),
         text::suggestion(value.text, words));
  }
  return static_cast<std::size_t>(match - words.begin());
}

bool is_none(const PlacedValue& place) {
  const bool none = place.value.text == "none";
  if (!none && !place.value.is(Value::Kind::map)) {
    throw_unexpected(place, "a map or none");
  }
  return none;
}

bool is_word(const PlacedValue& place, std::string_view word, std::string_view phrase) {
  const Value& value = place.value;
  if (value.text == word) {
    return true;
  }
  if (value.text.empty() || !is_digit(value.text.front())) {
    const std::array words = {word};
    fail(place, "expected {} or {}, found {}{}", word, phrase, found(value),
         text::suggestion(value.text, words));
  }
  return false;
}

PlacedValue PlacedValue::at(std::string_view key) const {
  const Value* found = find(key);
  if (found == nullptr) {
    fail(*this, "key '{}' is missing", key);
  }
  return {*found, join_path(path, key), scene};
}

PlacedValue PlacedValue::at(const Entry& entry) const {
  return {entry.value, join_path(path, entry.key), scene};
}

std::string location_text(const PlacedValue& place) {
  return to_string(place.value.location);
}

void check_keys(const PlacedValue& map, std::span<const std::string_view> keys) {
  if (!map.value.is(Value::Kind::map)) {
    throw_unexpected(map, fmt::format("a map (allowed: {})", fmt::join(keys, ", ")));
  }
  for (const Entry& entry : map.value.entries) {
    if (std::ranges::find(keys, entry.key) == keys.end()) {
      fail(entry.location, "unknown key {}{} (allowed: {}){}", text::quoted(entry.key),
           map.path.empty() ? "" : " in " + map.path, fmt::join(keys, ", "),
           suggestion(entry, map.path, keys));
    }
  }
}

std::string_view PlacedValue::only_key(std::span<const std::string_view> keys) const {
  std::vector<std::string_view> present;
  std::ranges::copy_if(keys, std::back_inserter(present),
                       [this](std::string_view key) { return find(key) != nullptr; });
  if (present.size() != 1) {
    fail(*this, "expected exactly one of {}, found {}", fmt::join(keys, ", "),
         present.empty() ? "none" : fmt::format("{}", fmt::join(present, " and ")));
  }
  return present.front();
}

}  // namespace clca::scene
