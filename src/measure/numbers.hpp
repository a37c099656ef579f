#pragma once
// Numbers of several measures: positions on an edge of cells, columns, lines, where an edge lies on
// a site and rounding must not decide; means over the particles of regions.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "clca/measure/grid.hpp"
#include "clca/measure/probe.hpp"

namespace clca::measure {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// More than the rounding of any position, far less than the distance of a centre of mass from an
/// edge on which it does not lie: both are whole multiples of small fractions of a spacing.
inline constexpr double kRounding = 1e-9;  // lattice spacings, or shares of a part

/// Number of the equal part, counted from 0, that contains a position given in lengths of a part.
/// An edge belongs to the part after it.
inline double part_at(double position) {
  return std::floor(position + kRounding);
}

/// Number of the part that ends at an edge; else as part_at().
inline double part_before(double position) {
  return std::ceil(position - kRounding) - 1;
}

/// Calls visit(part, share) for the parts that a position is in, of `count` equal ones: an edge
/// between two belongs half to each, so that the mirror image of a bed has the mirror image of its
/// table. A position beyond an end is in the last part there.
template <class Visit>
void share_out(double position, std::size_t count, const Visit& visit) {
  const auto nearest = [=](double part) {
    return static_cast<std::size_t>(std::clamp(part, 0.0, static_cast<double>(count) - 1));
  };
  share_out(nearest(part_before(position)), nearest(part_at(position)), visit);
}

/// Mean velocity and granular temperature of the particles that start in each of several regions.
/// Of `regions` regions: `share_out(point, visit)` calls visit(region, share) for each that has a
/// point or a share of it. All is 0 where no particle starts. Units as in motion_in().
/// Two passes: the difference of two means would not be exactly 0 where all particles move alike.
template <class ShareOut>
std::vector<RegionMotion> motions_by_region(const std::vector<Displacement>& displacements,
                                            double steps, std::size_t regions, ShareOut share_out) {
  std::vector<RegionMotion> motions(regions);
  std::vector<double> sites(regions, 0.0);
  for (const Displacement& displacement : displacements) {
    share_out(displacement.from, [&](std::size_t region, double share) {
      sites[region] += share * displacement.sites;
      motions[region].particles += share;
      motions[region].velocity += share * displacement.sites * displacement.vector / steps;
    });
  }
  for (std::size_t region = 0; region < regions; ++region) {
    motions[region].velocity /= sites[region] > 0 ? sites[region] : 1;
  }
  for (const Displacement& displacement : displacements) {
    share_out(displacement.from, [&](std::size_t region, double share) {
      RegionMotion& motion = motions[region];
      const Eigen::Vector2d deviation = displacement.vector / steps - motion.velocity;
      motion.fluctuation +=
          0.5 * deviation.squaredNorm() * share * displacement.sites / sites[region];
    });
  }
  return motions;
}

}  // namespace clca::measure
