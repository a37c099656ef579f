#pragma once
// Walls that come and go between stages.

#include <cstddef>
#include <vector>

#include "clca/grains/occupancy.hpp"
#include "clca/grains/state.hpp"

namespace clca::grains {

/// Takes a wall away. Its places go to walls that cover them, too. Returns those that are free now.
std::vector<std::size_t> remove_wall(State& state, Occupancy& occupancy, std::size_t number);

/// Puts a wall where it is not yet. Returns false and changes nothing when a particle stands in its
/// way, or another wall and one of the two moves.
bool insert_wall(State& state, Occupancy& occupancy, std::size_t number);

}  // namespace clca::grains
