// Points and rectangles in the box.

#include "scene/geometry.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "scene/keyed_map.hpp"
#include "scene/limits.hpp"

namespace clca::scene {

lattice::Lattice lattice_of(const Box& box) {
  return lattice::Lattice::covering(box.width, box.height, box.periodic);
}

std::string shown(const lattice::Rectangle& edges) {
  return fmt::format("[{}, {}, {}, {}]", edges.left, edges.bottom, edges.right, edges.top);
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

void require_site(const lattice::Rectangle& region, const Place& place) {
  const Box& box = place.scene.box;
  if (holds_no_site(lattice_of(box), region)) {
    fail(place, "no site of the box, {} wide and {} high, lies in {}", box.width, box.height,
         shown(region));
  }
}

}  // namespace clca::scene
