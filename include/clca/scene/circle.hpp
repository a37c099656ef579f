#pragma once
// Discs, rings and parts of rings as sets of sites.

#include <vector>

#include "clca/lattice/region.hpp"

namespace clca::scene {

/// All lengths in lattice spacings.
struct Disc {
  Eigen::Vector2d centre;
  double radius = 0;

  bool operator==(const Disc& other) const {
    return centre == other.centre && radius == other.radius;
  }
};

/// From `radius` to `radius + thickness` from the centre.
struct Ring {
  Eigen::Vector2d centre;
  double radius = 0;
  double thickness = 1;

  bool operator==(const Ring& other) const {
    return centre == other.centre && radius == other.radius && thickness == other.thickness;
  }
};

/// The part of a ring from one angle anticlockwise to another, in degrees from the x axis.
struct Arc {
  Ring ring;
  double from = 0;
  double to = 0;  ///< above `from`, by less than 360

  bool operator==(const Arc&) const = default;
};

/// The sites of the region inside the shape or at most 10^-6 spacings outside it, column by column
/// from the left, upwards.
/// A ring at least one spacing thick is closed: no chain of neighbouring sites crosses it.
/// Throws std::invalid_argument unless the centre is valid for lattice::nearest_site, radius and
/// thickness are in [0, 10^8), and the angles are as in Arc and between -10^8 and 10^8.
std::vector<lattice::Site> sites_in(const lattice::SweptRegion& swept_region, const Disc& disc);
std::vector<lattice::Site> sites_in(const lattice::SweptRegion& swept_region, const Ring& ring);
std::vector<lattice::Site> sites_in(const lattice::SweptRegion& swept_region, const Arc& arc);

/// Whether sites_in() is empty. Does not build the list.
bool holds_no_site(const lattice::Lattice& lattice, const Disc& disc);
bool holds_no_site(const lattice::Lattice& lattice, const Ring& ring);
bool holds_no_site(const lattice::Lattice& lattice, const Arc& arc);

/// A rectangle that contains all the sites.
lattice::Rectangle around(const Disc& disc);
lattice::Rectangle around(const Ring& ring);
lattice::Rectangle around(const Arc& arc);

}  // namespace clca::scene
