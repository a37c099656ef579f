#pragma once
// Kinds of values that several keys have, and limits and patterns that several share.

#include <cstdint>
#include <limits>
#include <optional>
#include <set>
#include <string_view>
#include <vector>

#include "clca/image/image.hpp"
#include "scene/key.hpp"

namespace clca::scene {

inline constexpr std::uint64_t kVersion = 1;
inline constexpr const char* kNamePattern = "^[A-Za-z0-9_-]{1,64}$";
/// Pattern of names that expressions can use.
inline constexpr const char* kExpressionNamePattern = "^[A-Za-z_][A-Za-z0-9_]*$";
inline constexpr double kMaxBoxHeight = 1'000'000;
inline constexpr double kMaxCoordinate = 1'000'000;  ///< in lattice spacings
inline constexpr std::uint64_t kMaxParticles = std::numeric_limits<std::int32_t>::max();
inline constexpr std::uint64_t kMaxSpeciesWeight = 1'000'000;  ///< in a fill or source
inline constexpr double kMaxTime = 1e9;

Type<double> number_type(double low, double high);
Type<double> positive_type(double high);
/// A length in lattice spacings or, in a scene with `units`, with a unit of length.
Type<double> length_type(const Type<double>& number);
Type<int> integer_type(int low, int high);
Type<std::uint64_t> count_type(std::uint64_t low, std::uint64_t high);
Type<bool> bool_type();

/// [x, y], each from `-most` to `most`.
Type<Eigen::Vector2d> point_type(double most = kMaxCoordinate);
/// [left, bottom, right, top], not empty.
Type<lattice::Rectangle> rectangle_type();
/// `[left, bottom, right, top]`
std::string shown(const lattice::Rectangle& edges);
/// Refuses a rectangle that holds no site of the box. Throws SceneError.
void require_site(const lattice::Rectangle& region, const PlacedValue& place);
/// A rectangle that holds at least one site of the box.
Type<lattice::Rectangle> region_type();

/// The absolute path of a file or folder; a relative one begins at the folder of the scene.
Type<std::string> file_path_type();
/// Absolute path of a file named in a scene of this folder; empty if too long or not one line.
std::string absolute_path(const std::string& folder, const std::string& path);

/// "#rrggbb"
Type<image::Rgb> color_type();

/// A name that the scene gives to something.
Type<std::string> name_type();
/// A list of different names, as indices in `names` of the scene; `kind`: what they name.
Type<std::vector<std::size_t>> references_type(
    const std::string& kind, std::vector<std::string_view> (*names)(const Scene& scene));

/// The species of this name.
std::size_t read_species(const PlacedValue& place);
/// Numbers by species: each a whole number from 0 to `high`; 0 for those not named.
Type<std::vector<std::size_t>> counts_type(std::uint64_t high);
/// The same with at least one above 0.
Type<std::vector<std::uint32_t>> weights_type();

/// Reads the PNG file that the value names into the `rows` of a picture of the scene, from the top,
/// with a letter for each pixel. Throws SceneError, also at the first picture with which the rows
/// of all are larger than the text of a scene may be.
void read_rows(const PlacedValue& file, std::vector<std::string>& rows,
               const std::function<char(image::Rgb color)>& letter);
/// The key of such a file, in the place of `rows`: a run folder has no other file.
template <class Owner>
Key<Owner> picture_file_key(Action<Owner> read) {
  return custom_key<Owner>("file", file_path_type(),
                           "a PNG of up to 1000000 pixels; a relative path begins at the folder of "
                           "the scene",
                           read)
      .with_condition("this or `rows`");
}
/// Texts of one length, of `allowed` characters: `about` in messages, `pattern` in the schema.
Type<std::vector<std::string>> rows_type(bool (*allowed)(char letter), const std::string& about,
                                         const std::string& pattern);

/// `word` for no value (`is_word` holds), or a value of the type; `between` them in descriptions.
template <class T>
Type<std::optional<T>> or_word(const std::string& word, std::string_view between,
                               const Type<T>& type,
                               const std::function<bool(const PlacedValue& place)>& is_word) {
  return custom_type<std::optional<T>>(
      fmt::format("`{}`{}{}", word, between, type.allowed),
      any_of({word_schema(word), type.schema}),
      [=](const PlacedValue& place) {
        return is_word(place) ? std::nullopt : std::optional<T>(type.read(place));
      },
      [=](const std::optional<T>& value, const Scene& scene) {
        return value ? type.text(*value, scene) : Value::scalar(word);
      },
      type.keys);
}

/// `none`, or a value of the type.
template <class T>
Type<std::optional<T>> or_none(const Type<T>& type) {
  return or_word("none", ", ", type, is_none);
}

using PathOfItem = std::string (*)(const PlacedValue& item, std::size_t index);
/// A list of `least` to `most` values. `path_of`: path of an item in messages, if not the list's.
template <class T>
Type<std::vector<T>> list_type(const Type<T>& item, std::size_t least, std::size_t most,
                               PathOfItem path_of = nullptr) {
  AnyType type = {.allowed = {}, .schema = array_schema(item.schema, least, most)};
  // Reads into the list of the scene itself, as items may look at those before them.
  type.read_into = [=](const PlacedValue& place, void* result) {
    std::size_t index = 0;
    for (PlacedValue& entry : read_list(place, least, most, [&](auto& one) { item.read(one); })) {
      entry.path = path_of == nullptr ? entry.path : path_of(entry, index++);
      item.read_into(entry, &static_cast<std::vector<T>*>(result)->emplace_back());
    }
  };
  type.text_of = any_text<std::vector<T>>([=](const std::vector<T>& values, const Scene& scene) {
    Value result = Value::list();
    for (const T& value : values) {
      result.items.push_back(item.text(value, scene));
    }
    return result;
  });
  type.keys = item.keys;
  type.is_collection = item.keys != nullptr;
  return Type<std::vector<T>>(type);
}

/// Things by the names that the scene gives them; `name` is a member of each.
template <class Owner>
Type<std::vector<Owner>> by_name(const std::string& section, const Type<Owner>& thing,
                                 std::size_t least = 0) {
  AnyType type = {
      .allowed = "map of names",
      .schema = with(object_schema(thing.schema, kNamePattern),
                     fmt::format(R"("maxProperties": {}{})", kMaxItems,
                                 least > 0 ? fmt::format(R"(, "minProperties": {})", least) : ""))};
  type.read_into = [=](const PlacedValue& place,
                       void* result) {  // into the list, as in list_type()
    auto& things = *static_cast<std::vector<Owner>*>(result);
    for (const Entry& entry : read_named(place)) {
      Owner& added = things.emplace_back();
      thing.read_into({entry.value, join_path(section, entry.key), place.scene}, &added);
      added.name = entry.key;
    }
    if (things.size() < least) {
      fail(place, "expected at least one");
    }
  };
  type.text_of =
      any_text<std::vector<Owner>>([=](const std::vector<Owner>& things, const Scene& scene) {
        Value result = Value::map();
        result.one_entry_per_line = thing.keys != nullptr;
        for (const Owner& value : things) {
          result.add(value.name, thing.text(value, scene));
        }
        return result;
      });
  type.keys = thing.keys;
  type.is_collection = thing.keys != nullptr;
  return Type<std::vector<Owner>>(type);
}
template <class Owner>
Type<std::vector<Owner>> by_name(const std::string& section, const Map<Owner>& map,
                                 std::size_t least = 0) {
  return by_name(section, type_of(map), least);
}

/// Values of another type: `from` these, and back `to` these.
template <class T, class Other, class From, class To>
Type<T> converted(std::string_view allowed, const Type<Other>& type, const From& from,
                  const To& to) {
  return custom_type<T>(
      allowed, type.schema, [=](const PlacedValue& place) { return from(type.read(place)); },
      [=](const T& value, const Scene& scene) { return type.text(to(value), scene); }, type.keys);
}

/// A list with a value for each of these members.
template <class Owner, class T, class... Members>
Type<Owner> list_of_members(std::string_view allowed, const Type<T>& item,
                            Members Owner::*... members) {
  return converted<Owner>(
      allowed, list_type(item, sizeof...(members), sizeof...(members)),
      [=](const std::vector<T>& values) {
        Owner owner;
        std::size_t index = 0;
        ((owner.*members = values[index++]), ...);
        return owner;
      },
      [=](const Owner& owner) { return std::vector<T>{owner.*members...}; });
}

/// A map, or what `read` makes of another value; `text` writes that, and has none for a map.
template <class T, class Read>
Type<T> or_map(std::string_view allowed, const Schema& other, const Type<T>& map, const Read& read,
               std::type_identity_t<std::optional<Value> (*)(const T& value)> text = nullptr) {
  return custom_type<T>(
      fmt::format("{}, or map", allowed), any_of({other, map.schema}),
      [=](const PlacedValue& place) {
        return place.value.is(Value::Kind::map) ? map.read(place) : T(read(place));
      },
      [=](const T& value, const Scene& scene) {
        const auto other_text = text != nullptr ? text(value) : std::nullopt;
        return other_text ? *other_text : map.text(value, scene);
      },
      map.keys);
}

/// A list of `least` to `most` different values; messages show a repeated one, and `advice`.
template <class T>
Type<std::vector<T>> set_type(const Type<T>& item, std::size_t least, std::size_t most,
                              std::string (*shown)(const Value& item) = found,
                              const std::string& advice = {}) {
  Type<std::vector<T>> type = list_type(item, least, most);
  type.schema = with(type.schema, kUniqueItems);
  type.read_into = [=](const PlacedValue& place, void* result) {
    std::set<T> known;
    for (const PlacedValue& entry :
         read_list(place, least, most, [&](auto& one) { item.read(one); })) {
      const T value = item.read(entry);
      if (!known.insert(value).second) {
        fail(entry, "{} is named twice{}", shown(entry.value), advice);
      }
      static_cast<std::vector<T>*>(result)->push_back(value);
    }
  };
  return type;
}

/// `word`, or a number of the type, in messages `phrase`; `word` stands for none.
template <class T>
Type<std::optional<T>> word_or_value(const std::string& word, const Type<T>& type,
                                     const std::string& phrase) {
  return or_word(word, ", or ", type,
                 [=](const PlacedValue& place) { return is_word(place, word, phrase); });
}

/// One of the words.
template <class T, std::size_t kCount>
Type<T> choice_type(const std::array<Named<T>, kCount>& names) {
  const auto all = words(names);
  return custom_type<T>(
      fmt::format("`{}`", fmt::join(all, "`, `")),
      fmt::format(R"({{"enum": ["{}"]}})", fmt::join(all, R"(", ")")),
      [&names](const PlacedValue& place) { return names[read_word(place, words(names))].value; },
      [&names](const T& value) { return Value::scalar(std::string(name_of(names, value))); });
}

}  // namespace clca::scene
