#pragma once
// Kinds of values that several keys have.

#include <cstdint>
#include <vector>

#include "clca/image/image.hpp"
#include "scene/key.hpp"
#include "scene/limits.hpp"

namespace clca::scene {

/// `10^12` for round large numbers.
std::string shown_number(double number);

Type<double> number(double low, double high);
Type<double> above_zero(double high);
Type<int> integer(int low, int high);
Type<std::uint64_t> count(std::uint64_t low, std::uint64_t high);
Type<bool> yes_or_no();

/// [x, y]
Type<Eigen::Vector2d> point();
/// [left, bottom, right, top], not empty.
Type<lattice::Rectangle> rectangle();
/// The ends of a colour bar.
Type<ColorRange> color_range();
/// A rectangle that holds at least one site of the box.
Type<lattice::Rectangle> region();

/// The path of a file or folder, as an absolute one: relative ones begin at the folder of the
/// scene.
Type<std::string> file_path_type();

/// "#rrggbb"
Type<Color> color_type();

/// A name that the scene gives to something.
Type<std::string> name_type();
/// A list of names, each at most once, as indices of the things of this `kind`: `names` of the
/// scene.
Type<std::vector<std::size_t>> references(
    const std::string& kind,
    const std::function<std::vector<std::string_view>(const Scene&)>& names);

/// Numbers by species: each a whole number from 0 to `high`; 0 for those not named.
template <class Number>
Type<std::vector<Number>> by_species(std::uint64_t high) {
  return {
      .allowed = fmt::format("0 to {} by species", high),
      .schema =
          [=] {
            return Json{
                {"type", "object"},
                {"additionalProperties", {{"type", "integer"}, {"minimum", 0}, {"maximum", high}}}};
          },
      .read =
          [high](const Value& value, const std::string& path, const Scene& scene) {
            std::vector<Number> numbers(scene.species.size(), 0);
            for (const Entry& entry : read_map(value, path)) {
              const std::size_t species = read_reference(entry.key, entry.location, path, "species",
                                                         names_of(scene.species));
              numbers[species] =
                  static_cast<Number>(read_count(entry.value, join_path(path, entry.key), 0, high));
            }
            return numbers;
          },
      .text =
          [](const std::vector<Number>& numbers, const Scene& scene) {
            Yaml map = Yaml::map({});
            for (std::size_t i = 0; i < numbers.size(); ++i) {
              if (numbers[i] != 0) {
                map.entries.push_back({name_text(scene.species[i].name).text,
                                       Yaml::scalar(fmt::format("{}", numbers[i]))});
              }
            }
            return map;
          }};
}

/// The same with at least one above 0.
Type<std::vector<std::uint32_t>> weights_type();

/// The pixels of a PNG file that the value names. Throws SceneError.
image::Image read_picture(const Value& value, const std::string& path, const Scene& scene);
/// Texts of one length, of characters for which `allowed` holds; `about` names them in messages,
/// `pattern` in the schema.
Type<std::vector<std::string>> rows_type(const std::function<bool(char)>& allowed,
                                         const std::string& about, const std::string& pattern);

/// `word`, or a number of the type, in messages `phrase`; `word` stands for none.
template <class T>
Type<std::optional<T>> word_or(const std::string& word, const Type<T>& type,
                               const std::string& phrase) {
  return {.allowed = fmt::format("`{}`, or {}", word, type.allowed),
          .schema =
              [=] {
                return Json{{"anyOf", {{{"const", word}}, type.schema()}}};
              },
          .read = [=](const Value& value, const std::string& path,
                      const Scene& scene) -> std::optional<T> {
            if (is_word(value, path, word, phrase)) {
              return std::nullopt;
            }
            return type.read(value, path, scene);
          },
          .text =
              [=](const std::optional<T>& value, const Scene& scene) {
                return value ? type.text(*value, scene) : Yaml::scalar(word);
              }};
}

/// One of the words.
template <class T, std::size_t kCount>
Type<T> choice(const std::array<Named<T>, kCount>& names) {
  return {.allowed = fmt::format("`{}`", fmt::join(words(names), "`, `")),
          .schema =
              [=] {
                return Json{{"enum", words(names)}};
              },
          .read = [&names](const Value& value, const std::string& path,
                           const Scene& /*scene*/) { return read_choice(value, path, names); },
          .text =
              [&names](const T& value, const Scene& /*scene*/) {
                return Yaml::scalar(std::string(name_of(names, value)));
              }};
}

/// Things by the names that the scene gives them; `name` is a member of each.
template <class Owner>
Type<std::vector<Owner>> by_name(const std::string& section, Map<Owner> of, std::size_t least = 0) {
  const auto map = std::make_shared<const Map<Owner>>(std::move(of));
  const Descriptions keys = descriptions(map->keys);
  const auto schema = [=] {
    Json result = {{"type", "object"},
                   {"propertyNames", {{"pattern", kNamePattern}}},
                   {"additionalProperties", map_schema(keys, map->conditions)},
                   {"maxProperties", kMaxItems}};
    if (least > 0) {
      result["minProperties"] = least;
    }
    return result;
  };
  return {.allowed = "map of names",
          .schema = schema,
          .read =
              [=](const Value& value, const std::string& path, const Scene& scene) {
                std::vector<Owner> things;
                for (const Entry& entry : read_named(value, path)) {
                  things.push_back(
                      read_fields(entry.value, join_path(section, entry.key), *map, scene));
                  things.back().name = entry.key;
                }
                if (things.size() < least) {
                  fail(value.location, fmt::format("{}: expected at least one", path));
                }
                return things;
              },
          .text =
              [=](const std::vector<Owner>& things, const Scene& scene) {
                Yaml result = Yaml::map({});
                result.in_lines = true;
                for (const Owner& thing : things) {
                  result.entries.push_back(
                      {name_text(thing.name).text, text_of(map->keys, thing, scene)});
                }
                return result;
              },
          .keys = keys,
          .is_collection = true};
}

}  // namespace clca::scene
