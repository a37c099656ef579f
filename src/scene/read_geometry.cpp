// Places in the box: rectangles and points, outlets, sources.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scene/keyed_map.hpp"
#include "scene/limits.hpp"
#include "scene/sections.hpp"

namespace clca::scene {

namespace {

Eigen::Vector2d read_source_point(const Value& value, const std::string& path, const Box& box) {
  Eigen::Vector2d point = read_point(value, path);
  if (!lattice_of(box).contains(lattice::nearest_site(point))) {
    fail(value.location, fmt::format("{}: expected a point in the box, {} wide and {} high, found "
                                     "[{}, {}]",
                                     path, box.width, box.height, point.x(), point.y()));
  }
  return point;
}

lattice::Rectangle read_source_region(const Value& value, const std::string& path, const Box& box) {
  const lattice::Rectangle region = read_region(value, path, box);
  if (region.left < 0 || region.bottom < 0 || region.right > box.width || region.top > box.height) {
    fail(value.location,
         fmt::format("{}: expected a region in the box, {} wide and {} high, found {}", path,
                     box.width, box.height, shown(region)));
  }
  return region;
}

std::vector<std::uint32_t> read_weights(const Value& value, const std::string& path,
                                        const std::vector<std::string_view>& names) {
  std::vector<std::uint32_t> weights(names.size(), 0);
  for (const Entry& entry : read_map(value, path)) {
    const std::size_t species = read_reference(entry.key, entry.location, path, "species", names);
    weights[species] = static_cast<std::uint32_t>(
        read_count(entry.value, join_path(path, entry.key), 0, kMaxSpeciesWeight));
  }
  if (std::all_of(weights.begin(), weights.end(), [](auto weight) { return weight == 0; })) {
    fail(value.location, fmt::format("{}: expected a weight above 0", path));
  }
  return weights;
}

Source read_source(const Entry& entry, const Scene& scene) {
  const KeyedMap fields(entry.value, join_path("sources", entry.key), kSourceKeys);
  Source source;
  source.name = entry.key;
  const std::string_view key = fields.only({"at", "region"});
  if (key == "at") {
    source.place = read_source_point(fields.at(key), fields.path(key), scene.box);
  } else {
    source.place = read_source_region(fields.at(key), fields.path(key), scene.box);
  }
  const Value* weights = fields.find("species");
  source.weights = weights == nullptr
                       ? std::vector<std::uint32_t>(scene.species.size(), 1)
                       : read_weights(*weights, fields.path("species"), names_of(scene.species));
  source.rate = fields.number("rate", kMinRate, kMaxRate);
  if (fields.find("count") != nullptr) {
    source.count = fields.count("count", 1, kMaxParticles);
  }
  return source;
}

}  // namespace

std::string shown(const lattice::Rectangle& edges) {
  return fmt::format("[{}, {}, {}, {}]", edges.left, edges.bottom, edges.right, edges.top);
}

Eigen::Vector2d read_point(const Value& value, const std::string& path) {
  const std::vector<Value>& items = read_list(value, path, 2, 2);
  return {read_number(items[0], path, -kMaxCoordinate, kMaxCoordinate),
          read_number(items[1], path, -kMaxCoordinate, kMaxCoordinate)};
}

lattice::Rectangle read_rectangle(const Value& value, const std::string& path) {
  const std::vector<Value>& items = read_list(value, path, 4, 4);
  std::array<double, 4> edges = {};
  std::transform(items.begin(), items.end(), edges.begin(), [&](const Value& item) {
    return read_number(item, path, -kMaxCoordinate, kMaxCoordinate);
  });
  const auto [left, bottom, right, top] = edges;
  if (left >= right || bottom >= top) {
    fail(value.location,
         fmt::format("{}: expected [left, bottom, right, top] with left < right and "
                     "bottom < top, found [{}, {}, {}, {}]",
                     path, left, bottom, right, top));
  }
  return {left, bottom, right, top};
}

bool holds_no_site(const lattice::Lattice& lattice, const lattice::Rectangle& rectangle) {
  // Columns of one parity are alike, so the first inside of each decides.
  const auto bounded = [](double value, int most) {
    return static_cast<int>(std::clamp(value, 0.0, static_cast<double>(most)));
  };
  const int column = bounded(rectangle.left / lattice::kColumnPitch - 1, lattice.columns());
  const int row = bounded(rectangle.bottom - 1, lattice.rows());
  for (int i = column; i < std::min(column + 5, lattice.columns()); ++i) {
    for (int j = row; j < std::min(row + 4, lattice.rows()); ++j) {
      if (rectangle.contains(lattice::position(lattice::Site{i, j}))) {
        return false;
      }
    }
  }
  return true;
}

lattice::Rectangle read_region(const Value& value, const std::string& path, const Box& box) {
  const lattice::Rectangle region = read_rectangle(value, path);
  if (holds_no_site(lattice_of(box), region)) {
    fail(value.location, fmt::format("{}: no site of the box, {} wide and {} high, lies in {}",
                                     path, box.width, box.height, shown(region)));
  }
  return region;
}

std::vector<Source> read_sources(const Value& value, const Scene& scene) {
  std::vector<Source> sources;
  for (const Entry& entry : read_named(value, "sources")) {
    sources.push_back(read_source(entry, scene));
  }
  return sources;
}

std::vector<Outlet> read_outlets(const Value& value, const Scene& scene) {
  std::vector<Outlet> outlets;
  for (const Entry& entry : read_named(value, "outlets")) {
    const KeyedMap fields(entry.value, join_path("outlets", entry.key), kOutletKeys);
    outlets.push_back({entry.key,
                       read_region(fields.at("region"), fields.path("region"), scene.box),
                       to_string(fields.at("region").location)});
  }
  return outlets;
}

}  // namespace clca::scene
