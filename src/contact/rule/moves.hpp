#pragma once
// Moves of one step, site by site where there is room.

#include <cstdint>
#include <span>
#include <vector>

#include "clca/contact/state.hpp"
#include "clca/grains/footprint.hpp"

namespace clca::contact {

/// Moves each of the grains `ids` by a site in every direction in which its remainder asks for it
/// and its way is free; one that follows another goes with it. Appends the ids of those that moved
/// to `moved`, some more than once.
void move_grains(grains::State& state, std::span<Vector> remainders, grains::Occupancy& occupancy,
                 const grains::FootprintTable& footprints, lattice::Direction down,
                 std::span<const std::uint32_t> ids, std::vector<std::uint32_t>& moved);

}  // namespace clca::contact
