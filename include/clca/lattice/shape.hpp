#pragma once
// Particle shapes: connected sets of sites without holes (Sakaguchi et al. 2001, section 3).

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "clca/lattice/direction.hpp"

namespace clca::lattice {

/// A connected set of sites without holes, relative to a reference site at the origin.
class Shape {
 public:
  /// From a list of sites. Throws std::invalid_argument for an empty list, a site named twice, a
  /// set that does not connect or one that encloses a hole, and coordinates beyond 10^6; the others
  /// likewise.
  explicit Shape(std::vector<Axial> sites);

  /// All sites within `radius` steps of the centre: 3 radius (radius + 1) + 1 of them.
  static Shape hexagon(int radius);
  /// All sites on and inside the outline through `corners`.
  static Shape polygon(std::span<const Axial> corners);
  /// Hexagons of `radius` on `length` sites in an upright line.
  static Shape rod(int radius, int length);

  /// Sorted by x, then q.
  const std::vector<Axial>& sites() const { return sites_; }
  std::size_t size() const { return sites_.size(); }
  bool contains(Axial site) const;

  /// Sites to enter on a step in `direction`: (P + d) \ P.
  std::vector<Axial> lead(Direction direction) const;
  /// Sites left on a step in `direction`: P \ (P + d).
  std::vector<Axial> trail(Direction direction) const;

  /// Turned clockwise about the reference site by `sixths` times 60 degrees.
  Shape rotated(int sixths) const;
  /// True when `other` is this shape but for a translation.
  bool congruent(const Shape& other) const;

  /// Of the hexagon that this shape is, wherever its reference site; none where it is no hexagon.
  std::optional<int> hexagon_radius() const;

  /// Mean of the sites, in lattice spacings from the reference site.
  Eigen::Vector2d centroid() const;
  /// Diameter in lattice spacings of the circle with the area of the sites (sqrt(3)/2 each).
  double diameter() const;

  bool operator==(const Shape&) const = default;

 private:
  std::vector<Axial> sites_;
};

}  // namespace clca::lattice
