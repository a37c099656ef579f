#pragma once
// Mean velocity and granular temperature of the particles that start in each of several regions.

#include <optional>
#include <vector>

#include "clca/measure/probe.hpp"

namespace clca::measure {

/// Of `regions` regions that do not overlap: `region_of(point)` is the number of the one that has a
/// point, or nothing. All is 0 where no particle starts. Units as in motion_in().
/// Two passes: the difference of two means would not be exactly 0 where all particles move alike.
template <class RegionOf>
std::vector<RegionMotion> motions_by_region(const std::vector<Displacement>& displacements,
                                            double steps, std::size_t regions, RegionOf region_of) {
  std::vector<RegionMotion> motions(regions);
  std::vector<double> sites(regions, 0.0);
  for (const Displacement& displacement : displacements) {
    if (const std::optional<std::size_t> region = region_of(displacement.from)) {
      sites[*region] += displacement.sites;
      ++motions[*region].particles;
      motions[*region].velocity += displacement.sites * displacement.vector / steps;
    }
  }
  for (std::size_t region = 0; region < regions; ++region) {
    motions[region].velocity /= sites[region] > 0 ? sites[region] : 1;
  }
  for (const Displacement& displacement : displacements) {
    if (const std::optional<std::size_t> region = region_of(displacement.from)) {
      RegionMotion& motion = motions[*region];
      const Eigen::Vector2d deviation = displacement.vector / steps - motion.velocity;
      motion.fluctuation += 0.5 * deviation.squaredNorm() * displacement.sites / sites[*region];
    }
  }
  return motions;
}

}  // namespace clca::measure
