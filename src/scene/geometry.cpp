// Points and rectangles in the box.

#include "scene/geometry.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scene/keyed_map.hpp"
#include "scene/limits.hpp"

namespace clca::scene {

lattice::Lattice lattice_of(const Box& box) {
  return lattice::Lattice::covering(box.width, box.height, box.periodic);
}

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

void require_site(const lattice::Rectangle& region, const Value& value, const std::string& path,
                  const Box& box) {
  if (holds_no_site(lattice_of(box), region)) {
    fail(value.location, fmt::format("{}: no site of the box, {} wide and {} high, lies in {}",
                                     path, box.width, box.height, shown(region)));
  }
}

}  // namespace clca::scene
