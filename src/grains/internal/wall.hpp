#pragma once
// Removing and inserting walls between stages.

#include <cstddef>
#include <vector>

#include "clca/grains/state.hpp"
#include "grains/internal/occupancy_table.hpp"

namespace clca::grains {

/// Removes a wall. Its sites go to other walls that cover them. Returns the indices that are free
/// now.
std::vector<std::size_t> remove_wall(State& state, OccupancyTable& occupancy, std::size_t number);

/// Inserts a wall. Returns false and changes nothing if a particle is in its way, or another wall
/// while one of the two is a moving wall.
bool insert_wall(State& state, OccupancyTable& occupancy, std::size_t number);

}  // namespace clca::grains
