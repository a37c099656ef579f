#pragma once
// What walls that push do to a bed: the overlaps they have left, and how deep they have come.

#include <cstdint>
#include <optional>
#include <vector>

#include "clca/measure/contacts.hpp"

namespace clca::measure {

/// A wall that moves and the overlaps that began at it.
struct WallForce {
  std::size_t wall = 0;
  std::int32_t travel = 0;  ///< sites from home along the direction of the motion
  std::optional<std::uint64_t> stalled_since = {};  ///< step
  std::uint64_t stalls = 0;
  std::size_t particles = 0;      ///< that share sites with the wall itself
  std::uint64_t sites = 0;        ///< that the wall itself shares with particles
  std::uint64_t chain_sites = 0;  ///< shared in all contacts that began at the wall
  std::size_t jammed = 0;         ///< particles pushed from this wall that are at rest
};

struct ForceSummary {
  int depth_max = 0;         ///< unit moves
  std::uint64_t sites = 0;   ///< shared, over all contacts
  std::size_t contacts = 0;  ///< pairs
  std::size_t jammed = 0;    ///< particles that were pushed onto and are at rest
  /// Share of the sites shared by particles that lie within 45 degrees ahead of the wall where
  /// their push began; none where particles share no sites. Ahead is the direction of the push:
  /// at distance `a` beyond the foremost site of the wall the cone is as wide as the wall and
  /// wider by `a` on either side. Up to one spacing behind the foremost site it is as wide as the
  /// wall, for a straight wall is not flat on the lattice.
  std::optional<double> cone_share = {};
  std::vector<WallForce> walls = {};  ///< all that have a motion, present or not, in their order
};

/// `occupancy` and `contacts` are those of this state; std::invalid_argument where they cannot be.
ForceSummary force_summary(const grains::State& state, const grains::Occupancy& occupancy,
                           const std::vector<Contact>& contacts);

/// How deep the foremost point of a wall that moves up or down lies under the surface that the bed
/// had when the stage began, in lattice spacings: under the mean of the profile (surface_profile)
/// over the columns with particles that the wall covers. Negative above it; none where the wall is
/// removed, moves sideways or covers no bed. Throws std::invalid_argument unless the surface has
/// one height for each column.
std::optional<double> penetration(const grains::State& now, const grains::Wall& wall,
                                  const std::vector<double>& surface_at_start);

}  // namespace clca::measure
