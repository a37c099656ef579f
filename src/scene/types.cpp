#include "scene/types.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <system_error>

#include "clca/text/message.hpp"
#include "scene/geometry.hpp"

namespace clca::scene {

namespace {

/// A type without need of the scene.
template <class T, class Read, class Text>
Type<T> plain_type(const std::string& allowed, const Schema& schema, Read read, Text text) {
  return {.allowed = allowed,
          .schema = schema,
          .read = [read](const Value& value, const std::string& path, const Scene& /*scene*/) -> T {
            return read(value, path);
          },
          .text = [text](const T& value, const Scene& /*scene*/) { return text(value); }};
}

/// One that fmt writes.
template <class T, class Read>
Type<T> scalar_type(const std::string& allowed, const Schema& schema, Read read) {
  return plain_type<T>(allowed, schema, read,
                       [](const T& value) { return Yaml::scalar(fmt::format("{}", value)); });
}

std::string range(double low, double high) {
  return fmt::format("{} to {}", shown_number(low), shown_number(high));
}

std::string read_path(const Value& value, const std::string& path, const Scene& scene) {
  const std::string& given = read_text(value, path);
  std::error_code error;
  std::string file =
      std::filesystem::absolute(std::filesystem::path(std::string(scene.folder)) / given, error)
          .lexically_normal()
          .string();
  if (given.empty() || error || file.size() > kMaxPathLength || !line_length(file)) {
    fail(value.location, fmt::format("{}: expected a path of up to {} bytes of UTF-8, found {}",
                                     path, kMaxPathLength, text::shown(given)));
  }
  return file;
}

Json numbers_schema(std::size_t size) {
  return {
      {"type", "array"},
      {"items", {{"type", "number"}, {"minimum", -kMaxCoordinate}, {"maximum", kMaxCoordinate}}},
      {"minItems", size},
      {"maxItems", size}};
}

}  // namespace

std::string shown_number(double number) {
  const double power = std::log10(std::abs(number));
  return power >= 9 && power == std::floor(power)
             ? fmt::format("{}10^{}", number < 0 ? "-" : "", power)
             : fmt::format("{}", number);
}

Type<double> number(double low, double high) {
  return scalar_type<double>(
      range(low, high),
      [=] {
        return Json{{"type", "number"}, {"minimum", low}, {"maximum", high}};
      },
      [=](const Value& value, const std::string& path) {
        return read_number(value, path, low, high);
      });
}

Type<double> above_zero(double high) {
  return scalar_type<double>(
      fmt::format("above 0, up to {}", shown_number(high)),
      [=] {
        return Json{{"type", "number"}, {"exclusiveMinimum", 0}, {"maximum", high}};
      },
      [=](const Value& value, const std::string& path) {
        return read_positive(value, path, high);
      });
}

Type<int> integer(int low, int high) {
  return scalar_type<int>(
      range(low, high),
      [=] {
        return Json{{"type", "integer"}, {"minimum", low}, {"maximum", high}};
      },
      [=](const Value& value, const std::string& path) {
        return read_int(value, path, low, high);
      });
}

constexpr std::uint64_t kMaxExact = std::uint64_t{1} << 53U;  // of a double

Type<std::uint64_t> count(std::uint64_t low, std::uint64_t high) {
  return scalar_type<std::uint64_t>(
      high < kMaxExact ? range(static_cast<double>(low), static_cast<double>(high))
                       : fmt::format("{} to {}", low, high),
      [=] {
        // Readers of schemas take whole numbers as signed ones.
        constexpr std::uint64_t kMaxSigned = std::numeric_limits<std::int64_t>::max();
        return Json{{"type", "integer"},
                    {"minimum", low},
                    {"maximum", high > kMaxSigned ? Json(static_cast<double>(high)) : Json(high)}};
      },
      [=](const Value& value, const std::string& path) {
        return read_count(value, path, low, high);
      });
}

Type<bool> yes_or_no() {
  return scalar_type<bool>(
      "`true`, `false`",
      [] {
        return Json{{"type", "boolean"}};
      },
      read_bool);
}

Type<Eigen::Vector2d> point() {
  return plain_type<Eigen::Vector2d>(
      "`[x, y]`", [] { return numbers_schema(2); }, read_point,
      [](const Eigen::Vector2d& point) {
        return Yaml::list({Yaml::number(point.x()), Yaml::number(point.y())});
      });
}

Type<ColorRange> color_range() {
  return plain_type<ColorRange>(
      "`[low, high]`", [] { return numbers_schema(2); },
      [](const Value& value, const std::string& path) {
        constexpr double kMost = 1e9;
        const std::vector<Value>& ends = read_list(value, path, 2, 2);
        const ColorRange range = {read_number(ends[0], path, 0, kMost),
                                  read_number(ends[1], path, 0, kMost)};
        if (range.low >= range.high) {
          fail(value.location,
               fmt::format("{}: expected [low, high] with low < high, found [{}, {}]", path,
                           range.low, range.high));
        }
        return range;
      },
      [](const ColorRange& range) {
        return Yaml::list({Yaml::number(range.low), Yaml::number(range.high)});
      });
}

Type<lattice::Rectangle> rectangle() {
  return plain_type<lattice::Rectangle>(
      "`[left, bottom, right, top]`", [] { return numbers_schema(4); }, read_rectangle,
      [](const lattice::Rectangle& edges) {
        return Yaml::list({Yaml::number(edges.left), Yaml::number(edges.bottom),
                           Yaml::number(edges.right), Yaml::number(edges.top)});
      });
}

Type<lattice::Rectangle> region() {
  Type<lattice::Rectangle> type = rectangle();
  type.read = [](const Value& value, const std::string& path, const Scene& scene) {
    const lattice::Rectangle region = read_rectangle(value, path);
    require_site(region, value, path, scene.box);
    return region;
  };
  return type;
}

Type<std::string> file_path_type() {
  return {
      .allowed = "a path",
      .schema =
          [] {
            return Json{{"type", "string"}, {"minLength", 1}, {"maxLength", kMaxPathLength}};
          },
      .read = read_path,
      .text = [](const std::string& file, const Scene& /*scene*/) { return quoted_text(file); }};
}

Type<std::string> name_type() {
  return plain_type<std::string>(
      "a name",
      [] {
        return Json{{"type", {"string", "number", "boolean"}}, {"pattern", kNamePattern}};
      },
      [](const Value& value, const std::string& path) {
        const std::string& name = read_text(value, path);
        check_name(name, value.location, path);
        return name;
      },
      [](const std::string& name) { return name_text(name); });
}

Type<std::vector<std::size_t>> references(
    const std::string& kind,
    const std::function<std::vector<std::string_view>(const Scene&)>& names) {
  return {
      .allowed = fmt::format("names of {}s", kind),
      .schema =
          [=] {
            return Json{{"type", "array"},
                        {"items", name_type().schema()},
                        {"uniqueItems", true},
                        {"maxItems", kMaxItems}};
          },
      .read =
          [=](const Value& value, const std::string& path, const Scene& scene) {
            std::vector<std::size_t> places;
            for (const Value& item : read_list(value, path, 0, kMaxItems)) {
              places.push_back(
                  read_reference(read_text(item, path), item.location, path, kind, names(scene)));
              if (std::find(places.begin(), places.end() - 1, places.back()) != places.end() - 1) {
                fail(item.location, fmt::format("{}: {} is named twice", path, found(item)));
              }
            }
            return places;
          },
      .text =
          [=](const std::vector<std::size_t>& places, const Scene& scene) {
            std::vector<Yaml> items;
            for (const std::size_t place : places) {
              items.push_back(name_text(names(scene)[place]));
            }
            return Yaml::list(std::move(items));
          }};
}

}  // namespace clca::scene
