#pragma once
// Discs, rings and parts of rings as sets of sites.

#include <variant>
#include <vector>

#include "clca/lattice/region.hpp"

namespace clca::scene {

/// All lengths in lattice spacings.
struct Disc {
  Eigen::Vector2d centre;
  double radius = 0;
};

/// From `radius` to `radius + thickness` from the centre.
struct Ring {
  Eigen::Vector2d centre;
  double radius = 0;
  double thickness = 1;
};

/// The part of a ring from one angle anticlockwise to another, in degrees from the x axis.
struct Arc {
  Ring ring;
  double from = 0;
  double to = 0;  ///< above `from`, by less than 360
};

using Circle = std::variant<Disc, Ring, Arc>;

/// The sites of the region inside the shape or at most 10^-6 spacings outside it, column by column
/// from the left, upwards.
/// A ring at least one spacing thick is closed: no chain of neighbouring sites crosses it.
/// Throws std::invalid_argument unless the centre is valid for lattice::nearest_site, radius and
/// thickness are in [0, 10^8), and the angles are as in Arc and between -10^8 and 10^8.
std::vector<lattice::Site> sites_in(const lattice::SweptRegion& swept_region, const Circle& circle);

/// Whether sites_in() is empty. Does not build the list.
bool holds_no_site(const lattice::Lattice& lattice, const Circle& circle);

/// A rectangle that contains all sites of the circle.
lattice::Rectangle bounding_rectangle(const Circle& circle);

}  // namespace clca::scene
