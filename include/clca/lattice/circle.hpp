#pragma once
// Discs, rings and parts of rings as sets of sites.

#include <vector>

#include "clca/lattice/region.hpp"

namespace clca::lattice {

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

/// The sites inside or on the edge, those at most 10^-6 spacings outside included: those of the
/// lattice, or those that come into it. Up the columns from the left. A ring that is one spacing
/// thick or more is closed: no row of neighbouring sites leads through it. Each throws
/// std::invalid_argument unless the centre is as for nearest_site, radius and thickness are from 0
/// to less than 10^8 and the angles are as above and between -10^8 and 10^8.
std::vector<Site> sites_in(const Catchment& catchment, const Disc& disc);
std::vector<Site> sites_in(const Catchment& catchment, const Ring& ring);
std::vector<Site> sites_in(const Catchment& catchment, const Arc& arc);

/// Whether sites_in() is empty, without gathering the sites.
bool holds_no_site(const Lattice& lattice, const Disc& disc);
bool holds_no_site(const Lattice& lattice, const Ring& ring);
bool holds_no_site(const Lattice& lattice, const Arc& arc);

/// A rectangle that holds all of the sites.
Rectangle around(const Disc& disc);
Rectangle around(const Ring& ring);
Rectangle around(const Arc& arc);

}  // namespace clca::lattice
