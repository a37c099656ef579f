#include "scene/geometry.hpp"

#include <algorithm>

#include "clca/lattice/region.hpp"

namespace clca::scene {

lattice::Lattice lattice_of(const Box& box) {
  return lattice::Lattice::covering(box.width, box.height, box.periodic);
}

std::string shown(const lattice::Rectangle& edges) {
  return fmt::format("[{}, {}, {}, {}]", edges.left, edges.bottom, edges.right, edges.top);
}

bool any_site(const lattice::SweptRegion& swept_region, const lattice::Rectangle& rectangle,
              const std::function<bool(lattice::Site)>& found) {
  const int first = swept_region.first_column();
  const int end = swept_region.end_column();
  const int last = lattice::bounded(rectangle.right / lattice::kColumnPitch + 2, first, end);
  for (int column = lattice::bounded(rectangle.left / lattice::kColumnPitch - 1, first, end);
       column < last; ++column) {
    const lattice::RowRange rows = swept_region.rows(column);
    const auto row_at = [&](double height) {
      return lattice::bounded(height, rows.first, std::max(rows.first, rows.end));
    };
    const int end_row = row_at(rectangle.top + 2);
    for (int row = row_at(rectangle.bottom - 1); row < end_row; ++row) {
      const lattice::Site site = {column, row};
      if (rectangle.contains(lattice::position(site)) && found(site)) {
        return true;
      }
    }
  }
  return false;
}

bool holds_no_site(const lattice::Lattice& lattice, const lattice::Rectangle& rectangle) {
  return !any_site(lattice::SweptRegion(lattice), rectangle, [](lattice::Site) { return true; });
}

bool holds_no_site(const lattice::Lattice& lattice, const lattice::Segment& segment) {
  // First without its thickness: a thick line across the box has many sites.
  const lattice::Segment thin = {segment.from, segment.to, 0};
  return lattice::sites_along(lattice, thin).empty() &&
         lattice::sites_along(lattice, segment).empty();
}

void require_site(const lattice::Rectangle& region, const Place& place) {
  const Box& box = place.scene.box;
  if (holds_no_site(lattice_of(box), region)) {
    fail(place, "no site of the box, {} wide and {} high, lies in {}", box.width, box.height,
         shown(region));
  }
}

}  // namespace clca::scene
