#include "clca/lattice/shape.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <stdexcept>

#include "clca/lattice/lattice.hpp"

namespace clca::lattice {

namespace {

/// Number of sites of the sorted list `sites` that unit steps within it reach from its first.
std::size_t reachable(const std::vector<Axial>& sites) {
  std::vector<bool> seen(sites.size(), false);
  std::vector<std::size_t> open = {0};
  seen[0] = true;
  std::size_t count = 0;
  while (!open.empty()) {
    const Axial site = sites[open.back()];
    open.pop_back();
    ++count;
    for (const Direction direction : kDirections) {
      const Axial neighbour = site + unit(direction);
      const auto found = std::lower_bound(sites.begin(), sites.end(), neighbour);
      const auto place = static_cast<std::size_t>(found - sites.begin());
      if (found != sites.end() && *found == neighbour && !seen[place]) {
        seen[place] = true;
        open.push_back(place);
      }
    }
  }
  return count;
}

struct Bounds {
  Axial low;
  Axial high;
};

Bounds bounds(std::span<const Axial> sites) {
  Bounds result = {sites.front(), sites.front()};
  for (const Axial site : sites) {
    result.low = {std::min(result.low.x, site.x), std::min(result.low.q, site.q)};
    result.high = {std::max(result.high.x, site.x), std::max(result.high.q, site.q)};
  }
  return result;
}

bool encloses_hole(const std::vector<Axial>& sites) {
  const Bounds box = bounds(sites);
  std::vector<Axial> outside;  // sorted by construction, with a margin that connects all around
  for (int x = box.low.x - 1; x <= box.high.x + 1; ++x) {
    for (int q = box.low.q - 1; q <= box.high.q + 1; ++q) {
      if (!std::binary_search(sites.begin(), sites.end(), Axial{x, q})) {
        outside.push_back({x, q});
      }
    }
  }
  return reachable(outside) != outside.size();
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

/// Twice the signed area of the triangle a, b, c in axial units: 0 when they lie on one line.
long long cross(Axial a, Axial b, Axial c) {
  const Axial first = b - a;
  const Axial second = c - a;
  return static_cast<long long>(first.x) * second.q - static_cast<long long>(first.q) * second.x;
}

bool on_edge(Axial from, Axial to, Axial site) {
  return cross(from, to, site) == 0 && std::min(from.x, to.x) <= site.x &&
         site.x <= std::max(from.x, to.x) && std::min(from.q, to.q) <= site.q &&
         site.q <= std::max(from.q, to.q);
}

/// True on the outline and inside it (even-odd rule), exact in integers.
bool on_or_inside(std::span<const Axial> corners, Axial site) {
  bool inside = false;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Axial from = corners[i];
    const Axial to = corners[(i + 1) % corners.size()];
    if (on_edge(from, to, site)) {
      return true;
    }
    if ((from.q > site.q) != (to.q > site.q)) {
      const bool left = cross(from, to, site) > 0;
      inside = inside != (left == (to.q > from.q));
    }
  }
  return inside;
}

}  // namespace

Shape::Shape(std::vector<Axial> sites) : sites_(std::move(sites)) {
  if (sites_.empty()) {
    throw std::invalid_argument("a shape has at least one site");
  }
  std::sort(sites_.begin(), sites_.end());
  if (std::adjacent_find(sites_.begin(), sites_.end()) != sites_.end()) {
    throw std::invalid_argument("a site of the shape is named twice");
  }
  if (reachable(sites_) != sites_.size()) {
    throw std::invalid_argument("the sites of the shape do not connect");
  }
  if (encloses_hole(sites_)) {
    throw std::invalid_argument("the shape encloses a hole");
  }
}

Shape Shape::hexagon(int radius) {
  return rod(radius, 1);
}

Shape Shape::rod(int radius, int length) {
  if (radius < 0 || length < 1) {
    throw std::invalid_argument("a rod has a radius of at least 0 and a length of at least 1");
  }
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

Shape Shape::polygon(std::span<const Axial> corners) {
  if (corners.size() < 3) {
    throw std::invalid_argument("a polygon has at least 3 corners");
  }
  const Bounds box = bounds(corners);
  std::vector<Axial> sites;
  for (int x = box.low.x; x <= box.high.x; ++x) {
    for (int q = box.low.q; q <= box.high.q; ++q) {
      if (on_or_inside(corners, {x, q})) {
        sites.push_back({x, q});
      }
    }
  }
  return Shape(std::move(sites));
}

bool Shape::contains(Axial site) const {
  return std::binary_search(sites_.begin(), sites_.end(), site);
}

std::vector<Axial> Shape::lead(Direction direction) const {
  return difference(shifted(sites_, unit(direction)), sites_);
}

std::vector<Axial> Shape::trail(Direction direction) const {
  return difference(sites_, shifted(sites_, unit(direction)));
}

Shape Shape::rotated(int sixths) const {
  const int turns = ((sixths % kDirectionCount) + kDirectionCount) % kDirectionCount;
  std::vector<Axial> sites = sites_;
  for (int turn = 0; turn < turns; ++turn) {
    std::transform(sites.begin(), sites.end(), sites.begin(), rotated_clockwise);
  }
  return Shape(std::move(sites));
}

bool Shape::congruent(const Shape& other) const {
  return sites_ == shifted(other.sites_, sites_.front() - other.sites_.front());
}

Eigen::Vector2d Shape::centroid() const {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (const Axial site : sites_) {
    sum += position(site);
  }
  return sum / static_cast<double>(sites_.size());
}

double Shape::diameter() const {
  return std::sqrt(4.0 * kColumnPitch * static_cast<double>(size()) / std::numbers::pi);
}

}  // namespace clca::lattice
