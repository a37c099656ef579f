#pragma once
// Particle shapes: connected sets of sites without holes (Sakaguchi et al. 2001, section 3).

#include <Eigen/Core>
#include <span>
#include <vector>

#include "clca/lattice/direction.hpp"

namespace clca::lattice {

/// A connected set of sites without holes, relative to a reference site at the origin.
class Shape {
 public:
  /// Throws std::invalid_argument if the list is empty, names a site twice, is not connected,
  /// encloses a hole, or has coordinates beyond 10^6. The other makers throw likewise.
  explicit Shape(std::vector<Axial> sites);

  /// All sites within `radius` steps of the centre: 3 radius (radius + 1) + 1 sites.
  static Shape hexagon(int radius);
  /// All sites within `radius` lattice spacings of the centre.
  static Shape disc(double radius);
  /// All sites on and inside the outline through `corners`.
  static Shape polygon(std::span<const Axial> corners);
  /// Hexagons of `radius` centred on `length` sites in a vertical line.
  static Shape rod(int radius, int length);

  /// Sorted by x, then q.
  const std::vector<Axial>& sites() const { return sites_; }
  std::size_t size() const { return sites_.size(); }
  bool contains(Axial site) const;

  /// Sites entered by a step in `direction`: (P + d) \ P.
  std::vector<Axial> lead_sites(Direction direction) const;
  /// Sites left by a step in `direction`: P \ (P + d).
  std::vector<Axial> trail_sites(Direction direction) const;

  /// Turned clockwise about the reference site by `sixths` times 60 degrees.
  Shape rotated(int sixths) const;
  /// True if `other` is a translation of this shape.
  bool is_congruent(const Shape& other) const;

  /// True for a hexagon with its reference site in the middle.
  bool is_hexagon() const;
  /// True for disc() of any radius.
  bool is_disc() const;
  bool is_round() const { return is_hexagon() || is_disc(); }

  /// Mean of the sites, in lattice spacings from the reference site.
  const Eigen::Vector2d& centroid() const { return centroid_; }
  /// Diameter, in lattice spacings, of the circle with the same area (sqrt(3)/2 per site).
  double diameter() const;

  bool operator==(const Shape&) const = default;

 private:
  std::vector<Axial> sites_;
  Eigen::Vector2d centroid_ = Eigen::Vector2d::Zero();  // kept: asked for at each centre
};

/// The shape with the site nearest to its centre of mass as reference, so that the origin of the
/// scene's coordinates does not matter.
Shape centred(const Shape& shape);

}  // namespace clca::lattice
