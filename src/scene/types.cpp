#include "scene/types.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <system_error>

#include "clca/scene/units.hpp"
#include "clca/scene/walls.hpp"

namespace clca::scene {

namespace {

constexpr std::size_t kMaxPathLength = 4096;

using Json = nlohmann::ordered_json;

constexpr auto kPlainText = [](const auto& value) {
  return Value::scalar(fmt::format("{}", value));
};

/// From `low` to `high`; `type` in the schema, where the limits may be other ones.
template <class T>
Type<T> ranged(const std::string& allowed, std::string_view type, const Json& lowest,
               const Json& highest, T low, T high) {
  const Json schema = {{"type", type}, {"minimum", lowest}, {"maximum", highest}};
  return custom_type<T>(
      allowed, schema.dump(),
      [=](const PlacedValue& place) { return read_number(place, low, high); }, kPlainText);
}

/// `10^12` for round large numbers.
std::string limit_text(double number) {
  const double power = std::log10(std::abs(number));
  return power >= 9 && power == std::floor(power)
             ? fmt::format("{}10^{}", number < 0 ? "-" : "", power)
             : fmt::format("{}", number);
}

std::string range(double low, double high) {
  return fmt::format("{} to {}", limit_text(low), limit_text(high));
}

std::string read_path(const PlacedValue& place) {
  const std::string& given = read_text(place);
  std::string file = absolute_path(place.scene.folder, given);
  if (file.empty()) {
    fail(place, "expected a path of up to {} bytes of UTF-8, found {}", kMaxPathLength,
         text::quoted(given));
  }
  return file;
}

std::string read_name(const PlacedValue& place) {
  const std::string& name = read_text(place);
  check_name(name, place.value.location, place.path);
  return name;
}

template <class Number>
Type<std::vector<Number>> by_species(std::uint64_t high) {
  return custom_type<std::vector<Number>>(
      fmt::format("0 to {} by species", high),
      fmt::format(R"({{"type": "object", "additionalProperties": {}}})",
                  count_type(0, high).schema),
      [high](const PlacedValue& place) {
        std::vector<Number> numbers(place.scene.species.size(), 0);
        for (const Entry& entry : read_map(place)) {
          const Value species = Value::scalar(entry.key, entry.location);
          numbers[read_species({species, place.path, place.scene})] =
              static_cast<Number>(read_number<std::uint64_t>(place.at(entry), 0, high));
        }
        return numbers;
      },
      [](const std::vector<Number>& numbers, const Scene& scene) {
        Value map = Value::map();
        for (std::size_t i = 0; i < numbers.size(); ++i) {
          if (numbers[i] != 0) {
            map.add(scene.species[i].name, kPlainText(numbers[i]));
          }
        }
        return map;
      });
}

}  // namespace

std::size_t read_species(const PlacedValue& place) {
  return read_reference(place, "species", names_of(place.scene.species));
}

Type<double> number_type(double low, double high) {
  return ranged(range(low, high), "number", low, high, low, high);
}

Type<double> positive_type(double high) {
  const auto read = [high](const PlacedValue& place) {
    const auto number = number_in<double>(place.value);
    if (!number || *number <= 0 || *number > high) {
      throw_unexpected(place, fmt::format("a number above 0 and up to {}", high));
    }
    return *number;
  };
  const Json schema = {{"type", "number"}, {"exclusiveMinimum", 0}, {"maximum", high}};
  return custom_type<double>(fmt::format("above 0, up to {}", limit_text(high)), schema.dump(),
                             read, kPlainText);
}

std::optional<double> metres_in(std::string_view text) {
  const std::size_t end = text.find_last_of("0123456789.") + 1;
  const std::size_t unit_begin = std::min(text.find_first_not_of(' ', end), text.size());
  const std::optional<double> number = number_in<double>(text.substr(0, end));
  for (const Named<double>& unit : kLengthUnits) {
    if (number && text.substr(unit_begin) == unit.name) {
      return *number / unit.value;
    }
  }
  return std::nullopt;
}

Type<double> length_type(const Type<double>& number) {
  Type<double> type = number;
  type.schema = with(number.schema, R"("pattern": "^-?[0-9.][0-9.eE+-]* *(m|cm|mm|um)$")");
  type.read_into = [number](const PlacedValue& place, void* result) {
    constexpr double kDecimals = 1e6;  // 20.5 mm are 82 spacings of 0.25 mm, and not a little less
    const std::string_view text = place.value.text;
    const std::optional<double> length = metres_in(text);
    const std::size_t end = text.find_last_of("0123456789.") + 1;
    const bool has_unit =
        length || (end < text.size() && number_in<double>(text.substr(0, end)).has_value());
    if (has_unit && !place.scene.units) {
      fail(place,
           "expected lattice spacings, as in a scene without units, found {}; "
           "'units: {{spacing: 1 mm}}'{} says how long a spacing is",
           found(place), place.scene.model == Model::contact ? "" : " with 'model: contact'");
    }
    if (has_unit && !length) {
      fail(place, "expected lattice spacings, or a length with one of the units {}, found {}",
           fmt::join(words(kLengthUnits), ", "), found(place));
    }
    Value value = place.value;
    if (length) {
      const double spacings = *length / place.scene.units->spacing;
      value = Value::number(std::round(spacings * kDecimals) / kDecimals + 0.0);  // 0 for -0
      value.location = place.value.location;
      value.expression = place.value.text;
    }
    number.read_into({value, place.path, place.scene}, result);
  };
  return type;
}

Type<int> integer_type(int low, int high) {
  return ranged(range(low, high), "integer", low, high, low, high);
}

Type<std::uint64_t> count_type(std::uint64_t low, std::uint64_t high) {
  constexpr std::uint64_t kMaxExact = std::uint64_t{1} << 53U;  // of a double
  // Readers of schemas take whole numbers as signed ones.
  constexpr std::uint64_t kMaxSigned = std::numeric_limits<std::int64_t>::max();
  return ranged(high < kMaxExact ? range(static_cast<double>(low), static_cast<double>(high))
                                 : fmt::format("{} to {}", low, high),
                "integer", low, high > kMaxSigned ? Json(static_cast<double>(high)) : Json(high),
                low, high);
}

Type<bool> bool_type() {
  const auto read = [](const PlacedValue& place) {
    const Value& value = place.value;
    if (value.quoted || (value.text != "true" && value.text != "false")) {
      throw_unexpected(place, "true or false");
    }
    return value.text == "true";
  };
  return custom_type<bool>("`true`, `false`", R"({"type": "boolean"})", read, kPlainText);
}

Type<Eigen::Vector2d> point_type(double most) {
  return converted<Eigen::Vector2d>(
      "`[x, y]`", list_type(length_type(number_type(-most, most)), 2, 2),
      [](const std::vector<double>& pair) { return Eigen::Vector2d(pair[0], pair[1]); },
      [](const Eigen::Vector2d& pair) {
        return std::vector<double>{pair.x(), pair.y()};
      });
}

Type<lattice::Rectangle> rectangle_type() {
  using lattice::Rectangle;
  const auto type = list_of_members(
      "`[left, bottom, right, top]`", length_type(number_type(-kMaxCoordinate, kMaxCoordinate)),
      &Rectangle::left, &Rectangle::bottom, &Rectangle::right, &Rectangle::top);
  return type.checked([](const lattice::Rectangle& edges, const PlacedValue& place) {
    if (edges.left >= edges.right || edges.bottom >= edges.top) {
      fail(place,
           "expected [left, bottom, right, top] with left < right and bottom < top, found {}",
           shown(edges));
    }
  });
}

std::string shown(const lattice::Rectangle& edges) {
  return fmt::format("[{}, {}, {}, {}]", edges.left, edges.bottom, edges.right, edges.top);
}

void require_site(const lattice::Rectangle& region, const PlacedValue& place) {
  const Box& box = place.scene.box;
  if (holds_no_site(lattice_of(box), region)) {
    fail(place, "no site of the box, {} wide and {} high, lies in {}", box.width, box.height,
         shown(region));
  }
}

Type<lattice::Rectangle> region_type() {
  return rectangle_type().checked(require_site);
}

std::string absolute_path(const std::string& folder, const std::string& path) {
  std::error_code error;
  std::string file = std::filesystem::absolute(std::filesystem::path(folder) / path, error)
                         .lexically_normal()
                         .string();
  const bool is_path =
      !path.empty() && !error && file.size() <= kMaxPathLength && line_length(file);
  return is_path ? file : std::string();
}

Type<std::string> file_path_type() {
  return custom_type<std::string>(
      "a path",
      fmt::format(R"({{"type": "string", "minLength": 1, "maxLength": {}}})", kMaxPathLength),
      read_path, [](const std::string& file) { return Value::quoted_text(file); });
}

Type<std::string> name_type() {
  return custom_type<std::string>("a name", scalar_schema(kNamePattern), read_name,
                                  [](const std::string& name) { return Value::name(name); });
}

Type<std::vector<std::size_t>> counts_type(std::uint64_t high) {
  return by_species<std::size_t>(high);
}

Type<std::vector<std::uint32_t>> weights_type() {
  auto type = by_species<std::uint32_t>(kMaxSpeciesWeight);
  type.schema = with(type.schema, R"("minProperties": 1)");
  return type.checked([](const std::vector<std::uint32_t>& weights, const PlacedValue& place) {
    if (std::ranges::all_of(weights, [](auto weight) { return weight == 0; })) {
      fail(place, "expected a weight above 0");
    }
  });
}

Type<std::vector<std::size_t>> references_type(
    const std::string& kind, std::vector<std::string_view> (*names)(const Scene& scene)) {
  const auto reference = custom_type<std::size_t>(
      "", name_type().schema,
      [=](const PlacedValue& place) { return read_reference(place, kind, names(place.scene)); },
      [=](std::size_t number, const Scene& scene) { return Value::name(names(scene)[number]); });
  auto type = set_type(reference, 0, kMaxItems);
  type.allowed = fmt::format("names of {}s", kind);
  type.schema = with(array_schema(reference.schema),
                     fmt::format(R"({}, "maxItems": {})", kUniqueItems, kMaxItems));
  return type;
}

}  // namespace clca::scene
