#include "clca/scene/circle.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <stdexcept>

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

/// Half the height of a circle at a horizontal distance from its centre; 0 outside.
double half_chord(double radius, double distance) {
  return std::sqrt(std::max(0.0, radius * radius - distance * distance));
}

using Visit = std::function<bool(Site)>;

/// Visits these rows of a column, upwards, until `visit` returns true for a site of the band.
bool visit_rows(const Band& band, int column, lattice::RowRange rows, const Visit& visit) {
  for (int row = rows.first; row < rows.end; ++row) {
    const Site site = {column, row};
    if (band.contains(lattice::position(site)) && visit(site)) {
      return true;
    }
  }
  return false;
}

/// Visits the sites, column by column from the left, until `visit` returns true.
bool visit_sites(const SweptRegion& swept_region, const Band& band, const Visit& visit) {
  constexpr double kMargin = 2;  // more than a row and what rounding may lose
  const int low = swept_region.first_column();
  const int high = swept_region.end_column();
  const int end =
      lattice::bounded((band.centre.x() + band.outer) / lattice::kColumnPitch + kMargin, low, high);
  for (int column =
           lattice::bounded((band.centre.x() - band.outer) / lattice::kColumnPitch - 1, low, high);
       column < end; ++column) {
    const lattice::RowRange all = swept_region.rows(column);
    const double distance = lattice::kColumnPitch * column - band.centre.x();
    const double outside = half_chord(band.outer, distance) + kMargin;
    const double inside = half_chord(band.inner, distance) - kMargin;
    const auto row_at = [&](double height) {
      return lattice::bounded(band.centre.y() + height, all.first, std::max(all.first, all.end));
    };
    // Below the inner circle and above it.
    const int first = row_at(-outside);
    const int last = row_at(outside);
    const int gap = inside > 0 ? row_at(-inside) : last;
    const int after_gap = inside > 0 ? row_at(inside) : last;
    if (visit_rows(band, column, {first, gap}, visit) ||
        visit_rows(band, column, {after_gap, last}, visit)) {
      return true;
    }
  }
  return false;
}

}  // namespace

std::vector<Site> sites_in(const SweptRegion& swept_region, const Circle& circle) {
  std::vector<Site> sites;
  visit_sites(swept_region, band_of(circle), [&](Site site) {
    sites.push_back(site);
    return false;
  });
  return sites;
}

bool holds_no_site(const Lattice& lattice, const Circle& circle) {
  return !visit_sites(SweptRegion(lattice), band_of(circle), [](Site) { return true; });
}

Rectangle around(const Circle& circle) {
  const Ring ring = ring_of(circle);
  const double reach = ring.radius + ring.thickness + 1;
  return {ring.centre.x() - reach, ring.centre.y() - reach, ring.centre.x() + reach,
          ring.centre.y() + reach};
}

}  // namespace clca::scene
