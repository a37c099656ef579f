#pragma once
// Mean velocity and granular temperature of the particles that start in each of several regions.

#include <vector>

#include "clca/measure/probe.hpp"

namespace clca::measure {

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
