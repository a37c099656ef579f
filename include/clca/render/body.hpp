#pragma once
// The shape of a particle in the plane, shared by both ways of drawing: the union of its sites, the
// bonds between neighbouring sites and the unit lattice triangles with all corners in the particle,
// each widened by a hexagon of circumradius 1/2 with corners in the lattice directions.
//
// Touching particles touch, disjoint ones never overlap. A point belongs to the owner of at least
// half of its barycentric weight in the lattice triangle around it. On the lattice of half the
// spacing the body is the union of the six small triangles around every site and bond midpoint.
// Points of that lattice are lattice::Axial, in half spacings.

#include <vector>

#include "clca/lattice/lattice.hpp"
#include "clca/lattice/shape.hpp"

namespace clca::render {

/// Where a point of the lattice of half spacings is, in lattice spacings.
inline Eigen::Vector2d position_from_halves(lattice::Axial half_spacings) {
  return lattice::position(half_spacings) / 2;
}

/// Corners of a closed polygon, in half spacings, the body on the left; no three in a row on one
/// line.
using Outline = std::vector<lattice::Axial>;

/// A piece of the body between two upright lines, in half spacings.
struct Trapezoid {
  lattice::Axial left_low, left_high;
  lattice::Axial right_low, right_high;
};

/// The outline of the body of `shape`, from its reference site: one, since shapes connect and have
/// no holes. Corners are bond midpoints, where the inner angle is 120 or 240 degrees.
Outline outline(const lattice::Shape& shape);

/// Cuts the body into few trapezoids.
std::vector<Trapezoid> trapezoids(const lattice::Shape& shape);

}  // namespace clca::render
