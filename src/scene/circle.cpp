// Discs, rings and parts of rings as sets of sites.

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "clca/scene/walls.hpp"

namespace clca::scene {

namespace {

using lattice::Lattice;
using lattice::Rectangle;
using lattice::Site;
using lattice::SweptRegion;

// More than any rounding error, so that sites on an edge are inside.
constexpr double kOnEdge = 1e-6;

/// The unit vector at an angle, to 1e-15; sums and products only: the same on every machine.
Eigen::Vector2d unit_at(double degrees) {
  constexpr double kDegree = 3.14159265358979323846 / 180;
  constexpr int kPowers = 20;
  const double quarter = std::round(degrees / 90);
  const double angle = (degrees - 90 * quarter) * kDegree;  // within an eighth of a turn
  double sine = 0;
  double cosine = 1;
  double term = 1;  // of the power series
  for (int power = 1; power < kPowers; power += 2) {
    term *= angle / power;
    sine += term;
    term *= -angle / (power + 1);
    cosine += term;
  }
  switch (static_cast<int>(quarter) & 3) {
    case 0:
      return {cosine, sine};
    case 1:
      return {-sine, cosine};
    case 2:
      return {-cosine, -sine};
    default:
      return {sine, -cosine};
  }
}

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// The directions between two angles.
struct Sector {
  Eigen::Vector2d from;
  Eigen::Vector2d to;
  bool wide = false;  ///< more than half a turn

  bool contains(const Eigen::Vector2d& from_centre) const {
    if (wide) {
      return cross(to, from_centre) <= kOnEdge || cross(from_centre, from) <= kOnEdge;
    }
    return cross(from, from_centre) >= -kOnEdge && cross(from_centre, to) >= -kOnEdge &&
           (from + to).dot(from_centre) >= -kOnEdge;
  }
};

/// What discs, rings and arcs have in common.
struct Band {
  Eigen::Vector2d centre;
  double inner = 0;  ///< radii that leave the edges inside
  double outer = 0;
  std::optional<Sector> sector = {};

  bool contains(const Eigen::Vector2d& point) const {
    const Eigen::Vector2d from_centre = point - centre;
    const double square = from_centre.squaredNorm();
    return square >= inner * inner && square <= outer * outer &&
           (!sector || sector->contains(from_centre));
  }
};

/// A disc is a ring without a hole.
Ring ring_of(const CircularPart& circle) {
  if (const auto* disc = std::get_if<Disc>(&circle)) {
    return {.centre = disc->centre, .radius = 0, .thickness = disc->radius};
  }
  const auto* arc = std::get_if<Arc>(&circle);
  return arc != nullptr ? arc->ring : std::get<Ring>(circle);
}

Band band_of(const CircularPart& circle) {
  const Ring ring = ring_of(circle);
  Band band = {.centre = ring.centre,
               .inner = std::max(0.0, ring.radius - kOnEdge),
               .outer = ring.radius + ring.thickness + kOnEdge};
  if (const auto* arc = std::get_if<Arc>(&circle)) {
    band.sector = {unit_at(arc->from_degrees), unit_at(arc->to_degrees),
                   arc->to_degrees - arc->from_degrees > 180};
  }
  return band;
}

/// Half the height of a circle at a horizontal distance from its centre; 0 outside.
double half_chord(double radius, double distance) {
  return std::sqrt(std::max(0.0, radius * radius - distance * distance));
}

/// Whether `test` holds for a site of the region in the band; columns from the left, upwards.
template <class Test>
bool any_site_in(const SweptRegion& swept_region, const Band& band, const Test& test) {
  const auto parts = [&](int column) {
    const double distance = lattice::kColumnPitch * column - band.centre.x();
    const double y = band.centre.y();
    const double outside = half_chord(band.outer, distance);
    const double inside = half_chord(band.inner, distance);
    std::array result = {std::pair(y - outside, y + outside),
                         std::pair<double, double>(INFINITY, -INFINITY)};
    if (inside > 2) {  // below the inner circle and above it
      result = {std::pair(y - outside, y - inside), std::pair(y + inside, y + outside)};
    }
    return result;
  };
  return lattice::any_site(
      swept_region, band.centre.x() - band.outer, band.centre.x() + band.outer, parts,
      [&](Site site) { return band.contains(lattice::position(site)) && test(site); });
}

}  // namespace

std::vector<Site> sites_in(const SweptRegion& swept_region, const CircularPart& circle) {
  std::vector<Site> sites;
  any_site_in(swept_region, band_of(circle), [&](Site site) {
    sites.push_back(site);
    return false;
  });
  return sites;
}

bool holds_no_site(const Lattice& lattice, const CircularPart& circle) {
  return !any_site_in(SweptRegion(lattice), band_of(circle), [](Site) { return true; });
}

Rectangle bounding_rectangle(const CircularPart& circle) {
  const Ring ring = ring_of(circle);
  const double reach = ring.radius + ring.thickness + 1;
  return {ring.centre.x() - reach, ring.centre.y() - reach, ring.centre.x() + reach,
          ring.centre.y() + reach};
}

}  // namespace clca::scene
