#pragma once
// What a probe sees: a rectangle of the box, in lattice spacings.

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "clca/grains/state.hpp"
#include "clca/lattice/region.hpp"
#include "clca/measure/snapshot.hpp"

namespace clca::measure {

/// Of each region, share of its sites without walls that particles cover; 0 if walls cover all.
std::vector<double> fillings(const grains::State& state,
                             std::span<const lattice::Rectangle> regions);

/// Means over the particles that start in a region, weighted by their sites.
struct RegionMotion {
  double particles = 0;  ///< at least one; half of each on an edge between two regions
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();
  double fluctuation = 0;  ///< 1/2 <|v - <v>|^2>, the granular temperature
};

/// Of displacements in `steps` steps; lattice spacings per step. None if no particle starts there.
std::optional<RegionMotion> motion_in(const lattice::Rectangle& region,
                                      const std::vector<Displacement>& displacements, double steps);

/// Sites of the particles whose centre of mass has passed the horizontal middle line of the region
/// downwards, less those that have passed it upwards. Each is taken to have gone straight from its
/// position at the snapshot, or where it has entered since (State::origins), to where it is or has
/// been removed.
double downward_flow(const Snapshot& before, const grains::State& now,
                     const lattice::Rectangle& region);

}  // namespace clca::measure
