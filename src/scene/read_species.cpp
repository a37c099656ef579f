// Species: shapes, orientations, colours.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "scene/keyed_map.hpp"
#include "scene/limits.hpp"
#include "scene/sections.hpp"

namespace clca::scene {

namespace {

constexpr int kSixth = 60;

std::vector<lattice::Axial> read_sites(const Value& value, const std::string& path,
                                       std::size_t least, std::size_t most) {
  std::vector<lattice::Axial> sites;
  std::map<lattice::Axial, bool> known;
  for (const Value& item : read_list(value, path, least, most)) {
    const std::vector<Value>& pair = read_list(item, path, 2, 2);
    sites.push_back({read_int(pair[0], path, -kMaxSiteCoordinate, kMaxSiteCoordinate),
                     read_int(pair[1], path, -kMaxSiteCoordinate, kMaxSiteCoordinate)});
    if (!known.emplace(sites.back(), true).second) {
      fail(item.location,
           fmt::format("{}: [{}, {}] is named twice", path, sites.back().x, sites.back().q));
    }
  }
  return sites;
}

RodSpec read_rod(const Value& value, const std::string& path) {
  const KeyedMap fields(value, path, kRodKeys);
  return {.radius = fields.integer("radius", 0, kMaxRadius),
          .length = fields.integer("length", 1, kMaxRodLength)};
}

ShapeSpec read_spec(const KeyedMap& fields) {
  const std::string_view key = fields.only({"hexagon", "sites", "polygon", "rod"});
  const Value& value = fields.at(key);
  const std::string path = fields.path(key);
  if (key == "hexagon") {
    return HexagonSpec{read_int(value, path, 0, kMaxRadius)};
  }
  if (key == "sites") {
    return SitesSpec{read_sites(value, path, 1, kMaxSites)};
  }
  if (key == "polygon") {
    return PolygonSpec{read_sites(value, path, 3, kMaxCorners)};
  }
  return read_rod(value, path);
}

lattice::Shape build(const HexagonSpec& spec) {
  return lattice::Shape::hexagon(spec.radius);
}
lattice::Shape build(const SitesSpec& spec) {
  return lattice::Shape(spec.sites);
}
lattice::Shape build(const PolygonSpec& spec) {
  return lattice::Shape::polygon(spec.corners);
}
lattice::Shape build(const RodSpec& spec) {
  return lattice::Shape::rod(spec.radius, spec.length);
}

/// Twice the area in axial units. Pick: a polygon that does not cross itself has more sites than
/// its area.
double doubled_area(const PolygonSpec& spec) {
  double sum = 0;
  for (std::size_t i = 0; i < spec.corners.size(); ++i) {
    const lattice::Axial from = spec.corners[i];
    const lattice::Axial to = spec.corners[(i + 1) % spec.corners.size()];
    sum += static_cast<double>(from.x) * to.q - static_cast<double>(to.x) * from.q;
  }
  return std::abs(sum);
}

lattice::Shape build_checked(const ShapeSpec& spec) {
  const std::string message = fmt::format("expected a shape of at most {} sites", kMaxSites);
  const auto* polygon = std::get_if<PolygonSpec>(&spec);
  if (polygon != nullptr && doubled_area(*polygon) > 2.0 * kMaxSites) {
    throw std::invalid_argument(message);  // before the sites are listed, which takes long
  }
  lattice::Shape shape = std::visit([](const auto& one) { return build(one); }, spec);
  if (shape.size() > kMaxSites) {
    throw std::invalid_argument(message);
  }
  return shape;
}

std::vector<int> read_orientations(const Value& value, const std::string& path) {
  if (value.is(Value::Kind::scalar) && value.text == "any") {
    return {0, 60, 120, 180, 240, 300};
  }
  if (!value.is(Value::Kind::list)) {
    fail(value.location,
         fmt::format("{}: expected any or a list of angles, found {}", path, found(value)));
  }
  std::vector<int> angles;
  for (const Value& item : read_list(value, path, 1, lattice::kDirectionCount)) {
    const int angle = read_int(item, path, 0, 360 - kSixth);
    if (angle % kSixth != 0) {
      fail(item.location, fmt::format("{}: expected a multiple of 60, found {}", path, angle));
    }
    if (std::find(angles.begin(), angles.end(), angle) != angles.end()) {
      fail(item.location, fmt::format("{}: {} is named twice", path, angle));
    }
    angles.push_back(angle);
  }
  return angles;
}

Color read_color(const Value& value, const std::string& path) {
  const std::string& text = value.text;
  const bool hexadecimal = text.size() == 7 && text.front() == '#' &&
                           text.find_first_not_of("0123456789abcdefABCDEF", 1) == std::string::npos;
  if (!value.is(Value::Kind::scalar) || !hexadecimal) {
    fail(value.location, fmt::format("{}: expected a colour like \"#3a6ea5\", in quotes, found {}",
                                     path, found(value)));
  }
  const auto part = [&](std::size_t start) {
    return static_cast<std::uint8_t>(std::stoi(text.substr(start, 2), nullptr, 16));
  };
  return {part(1), part(3), part(5)};
}

/// A particle that met itself across a periodic boundary would block itself.
void check_width(const Species& species, const Box& box, const Entry& entry) {
  if (!box.periodic) {
    return;
  }
  const int columns = lattice_of(box).columns();
  for (const int degrees : species.orientations) {
    const std::vector<lattice::Axial> sites = species.shape.rotated(degrees / kSixth).sites();
    const int width = sites.back().x - sites.front().x + 1;
    if (width >= columns) {
      fail(entry.location, fmt::format("{}: {} columns wide at {} degrees, too wide for a periodic "
                                       "box of {} columns",
                                       join_path("species", entry.key), width, degrees, columns));
    }
  }
}

}  // namespace

ReadShape read_shape(const Value& value, const std::string& path) {
  const KeyedMap fields(value, path, kShapeKeys);
  const ShapeSpec spec = read_spec(fields);
  try {
    return {spec, build_checked(spec)};
  } catch (const std::invalid_argument& error) {
    fail(value.location, fmt::format("{}: {}", path, error.what()));
  }
}

std::vector<Species> read_species(const Value& value, const Box& box) {
  std::vector<Species> all;
  for (const Entry& entry : read_named(value, "species")) {
    const KeyedMap fields(entry.value, join_path("species", entry.key), kSpeciesKeys);
    ReadShape read = read_shape(fields.at("shape"), fields.path("shape"));
    Species species{entry.key, std::move(read.spec), std::move(read.shape), {0}, {}};
    if (const Value* orientations = fields.find("orientations")) {
      species.orientations = read_orientations(*orientations, fields.path("orientations"));
    }
    if (const Value* color = fields.find("color")) {
      species.color = read_color(*color, fields.path("color"));
    }
    check_width(species, box, entry);
    all.push_back(std::move(species));
  }
  if (all.empty()) {
    fail(value.location, "species: expected at least one");
  }
  return all;
}

}  // namespace clca::scene
