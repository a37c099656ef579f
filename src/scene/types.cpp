#include "scene/types.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <system_error>

#include "clca/text/message.hpp"
#include "scene/geometry.hpp"

namespace clca::scene {

namespace {

/// One that fmt writes and such a function reads.
template <class T, class... Limits>
Type<T> scalar_type(const std::string& allowed, const Schema& schema,
                    T (*read)(const Value& value, std::string_view path, Limits... limits),
                    std::type_identity_t<Limits>... limits) {
  return own_type<T>(
      allowed, schema,
      [=](const Value& value, const std::string& path, const Scene& /*scene*/) {
        return read(value, path, limits...);
      },
      [](const T& value, const Scene& /*scene*/) {
        return Yaml::scalar(fmt::format("{}", value));
      });
}

std::string range(double low, double high) {
  return fmt::format("{} to {}", limit_text(low), limit_text(high));
}

std::string read_path(const Value& value, const std::string& path, const Scene& scene) {
  const std::string& given = read_text(value, path);
  std::string file = file_at(scene.folder, given);
  if (file.empty()) {
    fail(value.location, fmt::format("{}: expected a path of up to {} bytes of UTF-8, found {}",
                                     path, kMaxPathLength, text::shown(given)));
  }
  return file;
}

/// So many coordinates.
Schema coordinates_schema(std::size_t size) {
  return array_schema(number_schema(-kMaxCoordinate, kMaxCoordinate), size, size);
}

statistics::Range read_color_bar_ends(const Value& value, const std::string& path,
                                      const Scene& /*scene*/) {
  constexpr double kMost = 1e9;
  const std::vector<Value>& ends = read_list(value, path, 2, 2);
  const statistics::Range range = {read_number(ends[0], path, -kMost, kMost),
                                   read_number(ends[1], path, -kMost, kMost)};
  if (range.low >= range.high) {
    fail(value.location, fmt::format("{}: expected [low, high] with low < high, found [{}, {}]",
                                     path, range.low, range.high));
  }
  return range;
}

std::string read_name(const Value& value, const std::string& path, const Scene& /*scene*/) {
  const std::string& name = read_text(value, path);
  check_name(name, value.location, path);
  return name;
}

template <class Number>
Type<std::vector<Number>> by_species(std::uint64_t high) {
  return own_type<std::vector<Number>>(
      fmt::format("0 to {} by species", high), object_schema(count_schema(0, high)),
      [high](const Value& value, const std::string& path, const Scene& scene) {
        std::vector<Number> numbers(scene.species.size(), 0);
        for (const Entry& entry : read_map(value, path)) {
          const std::size_t species =
              read_reference(entry.key, entry.location, path, "species", names_of(scene.species));
          numbers[species] =
              static_cast<Number>(read_count(entry.value, join_path(path, entry.key), 0, high));
        }
        return numbers;
      },
      [](const std::vector<Number>& numbers, const Scene& scene) {
        Yaml map = Yaml::map({});
        for (std::size_t i = 0; i < numbers.size(); ++i) {
          if (numbers[i] != 0) {
            map.entries.push_back({name_text(scene.species[i].name).text,
                                   Yaml::scalar(fmt::format("{}", numbers[i]))});
          }
        }
        return map;
      });
}

}  // namespace

std::string limit_text(double number) {
  const double power = std::log10(std::abs(number));
  return power >= 9 && power == std::floor(power)
             ? fmt::format("{}10^{}", number < 0 ? "-" : "", power)
             : fmt::format("{}", number);
}

Yaml numbers_text(const std::vector<double>& numbers) {
  Yaml list = Yaml::list({});
  std::transform(numbers.begin(), numbers.end(), std::back_inserter(list.items), Yaml::number);
  return list;
}

Type<double> number(double low, double high) {
  return scalar_type<double>(range(low, high), number_schema(low, high), read_number, low, high);
}

Type<double> above_zero(double high) {
  return scalar_type<double>(fmt::format("above 0, up to {}", limit_text(high)),
                             above_zero_schema(high), read_positive, high);
}

Type<int> integer(int low, int high) {
  return scalar_type<int>(range(low, high), integer_schema(low, high), read_int, low, high);
}

Type<std::uint64_t> count(std::uint64_t low, std::uint64_t high) {
  constexpr std::uint64_t kMaxExact = std::uint64_t{1} << 53U;  // of a double
  return scalar_type<std::uint64_t>(high < kMaxExact
                                        ? range(static_cast<double>(low), static_cast<double>(high))
                                        : fmt::format("{} to {}", low, high),
                                    count_schema(low, high), read_count, low, high);
}

Type<bool> yes_or_no() {
  return scalar_type<bool>("`true`, `false`", schema(R"({"type": "boolean"})"), read_bool);
}

Type<Eigen::Vector2d> point() {
  return own_type<Eigen::Vector2d>(
      "`[x, y]`", coordinates_schema(2),
      [](const Value& value, const std::string& path, const Scene&) {
        return read_point(value, path);
      },
      [](const Eigen::Vector2d& point, const Scene&) {
        return numbers_text({point.x(), point.y()});
      });
}

Type<statistics::Range> color_bar_ends() {
  return own_type<statistics::Range>("`[low, high]`", coordinates_schema(2), read_color_bar_ends,
                                     [](const statistics::Range& range, const Scene&) {
                                       return numbers_text({range.low, range.high});
                                     });
}

Type<lattice::Rectangle> rectangle() {
  return own_type<lattice::Rectangle>(
      "`[left, bottom, right, top]`", coordinates_schema(4),
      [](const Value& value, const std::string& path, const Scene&) {
        return read_rectangle(value, path);
      },
      [](const lattice::Rectangle& edges, const Scene&) {
        return numbers_text({edges.left, edges.bottom, edges.right, edges.top});
      });
}

Type<lattice::Rectangle> region() {
  return rectangle().checked(
      [](const lattice::Rectangle& region, const Value& value, const std::string& path,
         const Scene& scene) { require_site(region, value, path, scene.box); });
}

std::string file_at(const std::string& folder, const std::string& path) {
  std::error_code error;
  std::string file = std::filesystem::absolute(std::filesystem::path(folder) / path, error)
                         .lexically_normal()
                         .string();
  const bool is_path =
      !path.empty() && !error && file.size() <= kMaxPathLength && line_length(file);
  return is_path ? file : std::string();
}

Type<std::string> file_path_type() {
  return own_type<std::string>(
      "a path",
      with(with(schema(R"({"type": "string"})"), "minLength", 1), "maxLength", kMaxPathLength),
      read_path, [](const std::string& file, const Scene&) { return quoted_text(file); });
}

Type<std::string> name_type() {
  return own_type<std::string>(
      "a name", scalar_schema(kNamePattern), read_name,
      [](const std::string& name, const Scene&) { return name_text(name); });
}

Type<std::vector<std::size_t>> counts_type(std::uint64_t high) {
  return by_species<std::size_t>(high);
}

Type<std::vector<std::uint32_t>> weights_type() {
  auto type = by_species<std::uint32_t>(kMaxSpeciesWeight);
  type.schema = with(type.schema, "minProperties", 1);
  return type.checked([](const std::vector<std::uint32_t>& weights, const Value& value,
                         const std::string& path, const Scene& /*scene*/) {
    if (std::all_of(weights.begin(), weights.end(), [](auto weight) { return weight == 0; })) {
      fail(value.location, fmt::format("{}: expected a weight above 0", path));
    }
  });
}

Type<std::vector<std::size_t>> references(
    const std::string& kind, std::vector<std::string_view> (*names)(const Scene& scene)) {
  return own_type<std::vector<std::size_t>>(
      fmt::format("names of {}s", kind),
      with(unique(array_schema(name_type().schema)), "maxItems", kMaxItems),
      [=](const Value& value, const std::string& path, const Scene& scene) {
        std::vector<std::size_t> numbers;
        for (const Value& item : read_list(value, path, 0, kMaxItems)) {
          numbers.push_back(
              read_reference(read_text(item, path), item.location, path, kind, names(scene)));
          if (std::find(numbers.begin(), numbers.end() - 1, numbers.back()) != numbers.end() - 1) {
            fail(item.location, fmt::format("{}: {} is named twice", path, found(item)));
          }
        }
        return numbers;
      },
      [=](const std::vector<std::size_t>& numbers, const Scene& scene) {
        std::vector<Yaml> items;
        for (const std::size_t number : numbers) {
          items.push_back(name_text(names(scene)[number]));
        }
        return Yaml::list(std::move(items));
      });
}

}  // namespace clca::scene
