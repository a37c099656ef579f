#pragma once
// Overlaps left by pushes. The number of shared sites is the index of force (Sakaguchi et al. 2001,
// after Murakami).

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "clca/grains/occupancy.hpp"
#include "clca/grains/state.hpp"

namespace clca::measure {

/// A particle that shares sites with another particle or a wall.
struct OverlapContact {
  std::uint32_t first = 0;
  grains::Owner second = 0;  ///< a particle with a greater id, or the code of a wall
  int sites = 0;             ///< shared
  /// 1 if one of the six moves of the first separates the two, else 2.
  int depth = 0;
  /// Centroid of the shared sites, in the box, in lattice spacings.
  Eigen::Vector2d point = Eigen::Vector2d::Zero();
  std::optional<std::uint32_t> source = {};  ///< wall where the push began
};

/// All pairs that share sites, sorted by `first`, then `second` (walls before particles).
/// Throws std::invalid_argument if `occupancy` belongs to another box.
std::vector<OverlapContact> contacts(const grains::State& state,
                                     const grains::Occupancy& occupancy);

/// Index of force of each particle by id: the shared sites of all its contacts.
/// Throws std::invalid_argument if a contact has an unknown particle.
std::vector<double> force_indices(std::size_t particle_count,
                                  const std::vector<OverlapContact>& contacts);

/// The push between the two of a contact, in either direction; null if there is none.
const grains::Push* push_between(const grains::State& state, const OverlapContact& contact);

}  // namespace clca::measure
