#include "clca/lattice/region.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace clca::lattice {

namespace {

double distance(const Segment& segment, const Eigen::Vector2d& point) {
  const Eigen::Vector2d along = segment.to - segment.from;
  const double square = along.squaredNorm();
  const double share =
      square > 0 ? std::clamp((point - segment.from).dot(along) / square, 0.0, 1.0) : 0.0;
  return (point - segment.from - share * along).norm();
}

/// The sites met on the way between the ends: neighbours follow each other.
std::vector<Site> chain_along(const Segment& segment) {
  const Site first = nearest_site(segment.from);
  const Site last = nearest_site(segment.to);
  const int steps = std::max(1, length(last - first));
  const Eigen::Vector2d start = position(first);
  const Eigen::Vector2d along = position(last) - start;
  std::vector<Site> chain;
  for (int i = 0; i <= steps; ++i) {
    // The nudge keeps points that lie exactly between two sites on one side of the line.
    const Eigen::Vector2d nudge(1e-6, 2e-6);
    chain.push_back(nearest_site(start + along * (static_cast<double>(i) / steps) + nudge));
  }
  return chain;
}

}  // namespace

Site nearest_site(const Eigen::Vector2d& point) {
  const int left = static_cast<int>(std::floor(point.x() / kColumnPitch));
  Site best;
  double least = INFINITY;
  for (const int column : {left, left + 1}) {
    const double shift = is_odd(column) ? 0.5 : 0.0;
    const Site site = {column, static_cast<int>(std::lround(point.y() - shift))};
    const double square = (position(site) - point).squaredNorm();
    if (square < least) {
      least = square;
      best = site;
    }
  }
  return best;
}

std::vector<Site> sites_in(const Lattice& lattice, const Rectangle& rectangle) {
  // Columns and rows that can hold a site of the rectangle; clamped before the cast.
  const auto bounded = [](double value, int high) {
    return static_cast<int>(std::clamp(value, 0.0, static_cast<double>(high)));
  };
  const int first_column = bounded(rectangle.left / kColumnPitch - 1, lattice.columns());
  const int last_column = bounded(rectangle.right / kColumnPitch + 2, lattice.columns());
  const int first_row = bounded(rectangle.bottom - 1, lattice.rows());
  const int last_row = bounded(rectangle.top + 2, lattice.rows());
  std::vector<Site> sites;
  for (int column = first_column; column < last_column; ++column) {
    for (int row = first_row; row < last_row; ++row) {
      if (rectangle.contains(position(Site{column, row}))) {
        sites.push_back({column, row});
      }
    }
  }
  return sites;
}

std::vector<Site> sites_along(const Lattice& lattice, const Segment& segment) {
  const double reach = 0.5 * segment.thickness;
  const Eigen::Vector2d margin(reach, reach);
  const Eigen::Vector2d low = segment.from.cwiseMin(segment.to) - margin;
  const Eigen::Vector2d high = segment.from.cwiseMax(segment.to) + margin;
  const double beyond = 1e-9;  // rectangles leave out their right and top edges
  std::vector<Site> sites =
      sites_in(lattice, {low.x() - beyond, low.y() - beyond, high.x() + beyond, high.y() + beyond});
  std::erase_if(sites, [&](Site site) { return distance(segment, position(site)) > reach; });
  for (const Site site : chain_along(segment)) {
    if (site.column >= 0 && site.column < lattice.columns() && site.row >= 0 &&
        site.row < lattice.rows()) {
      sites.push_back(site);
    }
  }
  std::sort(sites.begin(), sites.end());
  sites.erase(std::unique(sites.begin(), sites.end()), sites.end());
  return sites;
}

}  // namespace clca::lattice
