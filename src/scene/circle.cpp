#include "clca/scene/circle.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "scene/geometry.hpp"

namespace clca::scene {

namespace {

using lattice::Lattice;
using lattice::Rectangle;
using lattice::Site;
using lattice::SweptRegion;

// More than any rounding error, so that sites on an edge are inside.
constexpr double kOnEdge = 1e-6;
constexpr double kTooLong = 1e8;

/// The unit vector at an angle, to 1e-15. Sums and products only: the same on every machine. Not
/// the sine of the gas, whose last bits differ.
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
class Sector {
 public:
  explicit Sector(const Arc& arc)
      : from_(unit_at(arc.from)), to_(unit_at(arc.to)), wide_(arc.to - arc.from > 180) {}

  bool contains(const Eigen::Vector2d& from_centre) const {
    if (wide_) {
      return cross(to_, from_centre) <= kOnEdge || cross(from_centre, from_) <= kOnEdge;
    }
    return cross(from_, from_centre) >= -kOnEdge && cross(from_centre, to_) >= -kOnEdge &&
           (from_ + to_).dot(from_centre) >= -kOnEdge;
  }

 private:
  Eigen::Vector2d from_;
  Eigen::Vector2d to_;
  bool wide_;
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

void check_length(double length) {
  if (!(length >= 0 && length < kTooLong)) {
    throw std::invalid_argument("a radius or thickness is negative or too long");
  }
}

/// A disc is a ring without a hole.
Ring ring_of(const Circle& circle) {
  if (const auto* disc = std::get_if<Disc>(&circle)) {
    return {.centre = disc->centre, .radius = 0, .thickness = disc->radius};
  }
  const auto* arc = std::get_if<Arc>(&circle);
  return arc != nullptr ? arc->ring : std::get<Ring>(circle);
}

Band band_of(const Circle& circle) {
  const Ring ring = ring_of(circle);
  lattice::nearest_site(ring.centre);  // throws where it is too far
  check_length(ring.radius);
  check_length(ring.thickness);
  Band band = {.centre = ring.centre,
               .inner = std::max(0.0, ring.radius - kOnEdge),
               .outer = ring.radius + ring.thickness + kOnEdge};
  if (const auto* arc = std::get_if<Arc>(&circle)) {
    if (!(std::abs(arc->from) < kTooLong && arc->to > arc->from && arc->to - arc->from < 360)) {
      throw std::invalid_argument("an arc ends less than 360 degrees after it begins");
    }
    band.sector = Sector(*arc);
  }
  return band;
}

}  // namespace

std::vector<Site> sites_in(const SweptRegion& swept_region, const Circle& circle) {
  const Band band = band_of(circle);
  std::vector<Site> sites;
  any_site(swept_region, around(circle), [&](Site site) {
    if (band.contains(lattice::position(site))) {
      sites.push_back(site);
    }
    return false;
  });
  return sites;
}

bool holds_no_site(const Lattice& lattice, const Circle& circle) {
  const Band band = band_of(circle);
  return !any_site(SweptRegion(lattice), around(circle),
                   [&](Site site) { return band.contains(lattice::position(site)); });
}

Rectangle around(const Circle& circle) {
  const Ring ring = ring_of(circle);
  const double reach = ring.radius + ring.thickness + 1;
  return {ring.centre.x() - reach, ring.centre.y() - reach, ring.centre.x() + reach,
          ring.centre.y() + reach};
}

}  // namespace clca::scene
