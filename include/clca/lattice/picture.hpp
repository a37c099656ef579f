#pragma once
// A picture made of characters: sites by pixel.

#include <string>
#include <vector>

#include "clca/lattice/region.hpp"

namespace clca::lattice {

/// Pixels of equal size that cover a rectangle.
struct Picture {
  Rectangle box;  ///< what the pixels cover
  /// From the top, all of one length, at least one character long; of a wall, kDark and kLight.
  std::vector<std::string> rows;

  static constexpr char kDark = '#';
  static constexpr char kLight = '.';

  bool operator==(const Picture&) const = default;
};

/// The pixel at a point of the box of the picture. Throws std::invalid_argument if there are none.
char pixel_at(const Picture& picture, const Eigen::Vector2d& point);

/// The sites of the region in the box that lie on a dark pixel, column by column from the left,
/// upwards. Throws as check(Rectangle), and std::invalid_argument if there are no pixels.
std::vector<Site> sites_in(const SweptRegion& swept_region, const Picture& picture);

/// Whether sites_in() is empty.
bool holds_no_site(const Lattice& lattice, const Picture& picture);

/// A rectangle that contains all sites of the picture.
inline Rectangle bounding_rectangle(const Picture& picture) {
  return picture.box;
}

}  // namespace clca::lattice
