#pragma once
// The overlaps that pushes have left. Their sites are the index of force (Sakaguchi et al. 2001,
// after Murakami).

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "clca/grains/occupancy.hpp"
#include "clca/grains/state.hpp"

namespace clca::measure {

/// A particle that shares sites with another one or with a wall.
struct Contact {
  std::uint32_t first = 0;
  grains::Owner second = 0;  ///< a particle with a greater id, or the code of a wall
  int sites = 0;             ///< shared
  /// Unit moves needed to separate the two. For a wall: 1 if one of the six moves of the particle
  /// does it, 2 if none does.
  int depth = 0;
  /// Centroid of the shared sites, in lattice spacings; in a periodic box near `first`.
  Eigen::Vector2d place = Eigen::Vector2d::Zero();
  std::optional<std::uint32_t> source = {};  ///< wall where the push began
};

/// All pairs that share sites, by `first`, then `second` (walls before particles). `occupancy` is
/// that of the state; that of another box throws std::invalid_argument.
std::vector<Contact> contacts(const grains::State& state, const grains::Occupancy& occupancy);

/// Index of force of each particle by id: the sites it shares, over all its contacts. Throws
/// std::invalid_argument for a contact of a particle that is not there.
std::vector<double> force_indices(std::size_t particle_count, const std::vector<Contact>& contacts);

/// The push between the two of a contact, whichever was pushed; null where there is none.
const grains::Push* push_between(const grains::State& state, const Contact& contact);

}  // namespace clca::measure
