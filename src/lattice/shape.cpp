#include "clca/lattice/shape.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <numbers>
#include <numeric>
#include <set>
#include <utility>

#include "clca/lattice/lattice.hpp"
#include "lattice/internal/require.hpp"

namespace clca::lattice {

namespace {

/// Whether steps between neighbouring sites lead from each of the sites to each other one.
bool are_connected(const std::vector<Axial>& sites) {
  std::set<Axial> unseen(sites.begin(), sites.end());
  std::vector<Axial> open = {sites.front()};
  unseen.erase(sites.front());
  while (!open.empty()) {
    const Axial site = open.back();
    open.pop_back();
    for (const Direction direction : kDirections) {
      if (unseen.erase(site + unit(direction)) > 0) {
        open.push_back(site + unit(direction));
      }
    }
  }
  return unseen.empty();
}

bool holds(const std::vector<Axial>& sorted, Axial site) {
  return std::binary_search(sorted.begin(), sorted.end(), site);
}

/// Whether a connected, sorted list of sites has holes. Euler: sites - bonds + filled unit
/// triangles = connected parts - holes.
bool encloses_hole(const std::vector<Axial>& sites) {
  std::size_t bonds = 0;
  std::size_t triangles = 0;
  for (const Axial site : sites) {
    const bool up = holds(sites, site + unit(Direction::up));
    const bool up_right = holds(sites, site + unit(Direction::up_right));
    const bool down_right = holds(sites, site + unit(Direction::down_right));
    bonds += (up ? 1U : 0U) + (up_right ? 1U : 0U) + (down_right ? 1U : 0U);
    triangles += (up && up_right ? 1U : 0U) + (up_right && down_right ? 1U : 0U);
  }
  return sites.size() + triangles != bonds + 1;
}

std::vector<Axial> difference(const std::vector<Axial>& from, const std::vector<Axial>& minus) {
  std::vector<Axial> result;
  std::set_difference(from.begin(), from.end(), minus.begin(), minus.end(),
                      std::back_inserter(result));
  return result;
}

std::vector<Axial> shifted(const std::vector<Axial>& sites, Axial by) {
  std::vector<Axial> result;
  result.reserve(sites.size());
  for (const Axial site : sites) {
    result.push_back(site + by);
  }
  return result;
}

/// The mean, from sums of whole numbers: no rounding moves a centre off a column or a row.
Eigen::Vector2d mean_position(const std::vector<Axial>& sites) {
  std::int64_t columns = 0;
  std::int64_t half_spacings = 0;  // upwards
  for (const Axial site : sites) {
    columns += site.x;
    half_spacings += 2 * std::int64_t{site.q} + site.x;
  }
  const auto count = static_cast<double>(sites.size());
  return {kColumnPitch * (static_cast<double>(columns) / count),
          static_cast<double>(half_spacings) / (2 * count)};
}

constexpr int kMaxSiteCoordinate = 1'000'000;

void check_reach(Axial site) {
  require(site.x <= kMaxSiteCoordinate && site.x >= -kMaxSiteCoordinate &&
              site.q <= kMaxSiteCoordinate && site.q >= -kMaxSiteCoordinate,
          "a site of a shape is too far away");
}

/// The sites on the straight line from `from` to `to`.
void add_edge(Axial from, Axial to, std::vector<Axial>& sites) {
  const Axial along = to - from;
  const int steps = std::max(1, std::gcd(along.x, along.q));
  for (int i = 0; i <= steps; ++i) {
    sites.push_back({from.x + along.x / steps * i, from.q + along.q / steps * i});
  }
}

/// The first x on or beyond the line through `from` and `to` at the height `q`.
int first_beyond(Axial from, Axial to, int q) {
  const Axial along = from.q < to.q ? to - from : from - to;
  const long long distance = static_cast<long long>(along.x) * (q - from.q);
  const long long whole = distance / along.q;
  return from.x + static_cast<int>(whole * along.q < distance ? whole + 1 : whole);
}

/// The sites of height `q` inside the outline (even-odd rule), and some of those on it.
void add_inside(std::span<const Axial> corners, int q, std::vector<Axial>& sites) {
  std::vector<int> crossings;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Axial from = corners[i];
    const Axial to = corners[(i + 1) % corners.size()];
    if ((from.q > q) != (to.q > q)) {
      crossings.push_back(first_beyond(from, to, q));
    }
  }
  std::ranges::sort(crossings);
  for (std::size_t i = 0; i + 1 < crossings.size(); i += 2) {
    for (int x = crossings[i]; x < crossings[i + 1]; ++x) {
      sites.push_back({x, q});
    }
  }
}

}  // namespace

Shape::Shape(std::vector<Axial> sites) : sites_(std::move(sites)) {
  require(!sites_.empty(), "a shape has at least one site");
  std::ranges::for_each(sites_, check_reach);
  std::ranges::sort(sites_);
  require(std::ranges::adjacent_find(sites_) == sites_.end(), "a site of the shape is named twice");
  require(are_connected(sites_), "the sites of the shape do not connect");
  require(!encloses_hole(sites_), "the shape encloses a hole");
  centroid_ = mean_position(sites_);
}

Shape Shape::hexagon(int radius) {
  return rod(radius, 1);
}

Shape Shape::rod(int radius, int length) {
  require(radius >= 0 && length >= 1,
          "a rod has a radius of at least 0 and a length of at least 1");
  check_reach({radius, length});
  std::vector<Axial> sites;
  for (int x = -radius; x <= radius; ++x) {
    const int lowest = std::max(-radius, -radius - x);
    const int highest = std::min(radius, radius - x) + length - 1;
    for (int q = lowest; q <= highest; ++q) {
      sites.push_back({x, q});
    }
  }
  return Shape(std::move(sites));
}

Shape Shape::disc(double radius) {
  constexpr double kRounding = 1e-6;
  require(radius >= 0 && radius <= kMaxSiteCoordinate,
          "the radius of a disc is negative or too long");
  const auto reach = static_cast<int>(radius / kColumnPitch) + 1;
  std::vector<Axial> sites;
  for (int x = -reach; x <= reach; ++x) {
    for (int q = -reach; q <= reach; ++q) {
      if (position(Axial{x, q}).norm() <= radius + kRounding) {
        sites.push_back({x, q});
      }
    }
  }
  return Shape(std::move(sites));
}

Shape Shape::polygon(std::span<const Axial> corners) {
  require(corners.size() >= 3, "a polygon has at least 3 corners");
  std::ranges::for_each(corners, check_reach);
  std::vector<Axial> sites;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    add_edge(corners[i], corners[(i + 1) % corners.size()], sites);
  }
  const auto [lowest, highest] = std::ranges::minmax_element(
      corners, [](Axial left, Axial right) { return left.q < right.q; });
  for (int q = lowest->q; q <= highest->q; ++q) {
    add_inside(corners, q, sites);
  }
  std::ranges::sort(sites);
  sites.erase(std::unique(sites.begin(), sites.end()), sites.end());
  return Shape(std::move(sites));
}

bool Shape::contains(Axial site) const {
  return holds(sites_, site);
}

std::vector<Axial> Shape::lead_sites(Direction direction) const {
  return difference(shifted(sites_, unit(direction)), sites_);
}

std::vector<Axial> Shape::trail_sites(Direction direction) const {
  return difference(sites_, shifted(sites_, unit(direction)));
}

Shape Shape::rotated(int sixths) const {
  const int turns = ((sixths % kDirectionCount) + kDirectionCount) % kDirectionCount;
  std::vector<Axial> sites = sites_;
  for (int turn = 0; turn < turns; ++turn) {
    std::ranges::transform(sites, sites.begin(), rotated_clockwise);
  }
  return Shape(std::move(sites));
}

bool Shape::is_congruent(const Shape& other) const {
  return sites_ == shifted(other.sites_, sites_.front() - other.sites_.front());
}

bool Shape::is_hexagon() const {
  const int radius = std::max(sites_.back().x, 0);
  // Long shapes are told apart by their number of sites, before a large hexagon is built.
  return static_cast<double>(size()) == 3.0 * radius * (radius + 1.0) + 1 &&
         *this == hexagon(radius);
}

bool Shape::is_disc() const {
  double reach = 0;  // squared
  for (const Axial site : sites_) {
    reach = std::max(reach, position(site).squaredNorm());
  }
  // Long shapes are told apart by their number of sites, before a large disc is built.
  return static_cast<double>(size()) > 3 * reach && *this == disc(std::sqrt(reach));
}

double Shape::diameter() const {
  return std::sqrt(4.0 * kColumnPitch * static_cast<double>(size()) / std::numbers::pi);
}

Shape centred(const Shape& shape) {
  const auto& sites = shape.sites();
  const auto count = static_cast<long long>(sites.size());
  long long sum_x = 0;
  long long sum_q = 0;
  for (const Axial site : sites) {
    sum_x += site.x;
    sum_q += site.q;
  }
  // Squared distance from the centre of mass, times count squared: exact.
  const auto distance = [&](Axial site) {
    const long long x = count * site.x - sum_x;
    const long long q = count * site.q - sum_q;
    return x * x + x * q + q * q;
  };
  const Axial reference = *std::ranges::min_element(sites, {}, distance);
  return Shape(shifted(sites, Axial() - reference));
}

}  // namespace clca::lattice
