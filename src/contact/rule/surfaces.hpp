#pragma once
// The surfaces that walls and sides of the box form around a grain, however they are cut into
// bodies.

#include <vector>

#include "clca/contact/state.hpp"
#include "grains/internal/box.hpp"

namespace clca::contact {

/// The wall or side of the box, or the grain, at a site; kFree if there is none. Sites beyond the
/// border belong to the sides, too.
grains::Owner body_at(const grains::Box& box, lattice::Site site);

/// A wall or a side that blocks a grain.
struct Obstacle {
  grains::Owner body = grains::kFree;
  unsigned directions = 0;  ///< that it blocks, as bits
  /// Its sites next to the grain, from the reference site of that; one for each direction in which
  /// it blocks.
  std::vector<lattice::Axial> sites = {};
};

/// Puts the obstacles of a grain together, those that form one surface: a straight line separates
/// them, as far as they are near, from the grain. Two sides of the box never form one.
std::vector<std::vector<Obstacle>> surfaces(const grains::Box& box, const grains::Particle& grain,
                                            const std::vector<Obstacle>& obstacles);

/// Whether a straight line has all of `one` on one side and all of `other` on the other.
bool separable(const std::vector<lattice::Axial>& one, const std::vector<lattice::Axial>& other);

}  // namespace clca::contact
