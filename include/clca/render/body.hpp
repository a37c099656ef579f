#pragma once
// The shape of a particle in the plane, shared by both ways of drawing: the union of its sites, the
// bonds between neighbouring sites and the unit lattice triangles with all corners in the particle,
// each widened by a hexagon of circumradius 1/2 with corners in the lattice directions.
//
// Touching particles touch, disjoint ones never overlap. A point belongs to the owner of at least
// half of its barycentric weight in the lattice triangle around it. On the lattice of half the
// spacing the body is the union of the six small triangles around every site and bond midpoint.

#include <vector>

#include "clca/lattice/lattice.hpp"
#include "clca/lattice/shape.hpp"

namespace clca::render {

/// A point of the half-spacing lattice: `u` in half column pitches, `v` in quarter spacings.
struct GridPoint {
  int u = 0;
  int v = 0;

  constexpr auto operator<=>(const GridPoint&) const = default;
};

constexpr GridPoint grid_point(lattice::Site site) {
  return {2 * site.column, 2 * lattice::doubled_height(site)};
}

/// Cartesian position in lattice spacings.
inline Eigen::Vector2d position(GridPoint point) {
  return {0.5 * lattice::kColumnPitch * point.u, 0.25 * point.v};
}

/// Corners of a closed polygon, the body on the left; no three in a row on one line.
using Outline = std::vector<GridPoint>;

/// A piece of the body between two upright lines.
struct Trapezoid {
  GridPoint left_low, left_high;
  GridPoint right_low, right_high;
};

/// Of the body of `shape`, seen from its reference site: one outline, since shapes connect and have
/// no holes. Corners are bond midpoints, where the inner angle is 120 or 240 degrees.
Outline outline(const lattice::Shape& shape);

/// Cuts the body into few trapezoids.
std::vector<Trapezoid> trapezoids(const lattice::Shape& shape);

}  // namespace clca::render
