#pragma once
// Moves of one step, site by site where there is room.

#include <cstdint>
#include <span>
#include <vector>

#include "clca/contact/state.hpp"
#include "clca/grains/footprint.hpp"
#include "contact/rule/walls.hpp"
#include "grains/wall_step.hpp"

namespace clca::contact {

/// What moves of a step have changed: ids of grains, some more than once.
struct Moves {
  std::vector<std::uint32_t> moved;
  std::vector<std::uint32_t> beside_walls;  ///< beside places that walls have entered or left
};

/// Moves each of the grains `ids` by a site in every direction in which its remainder asks for it
/// and its way is free; one that follows another goes with it. Each of the walls takes the move
/// that it wants, and takes along what is in its way, and what is in the way of that, unless the
/// border or another wall is. What has been pushed may move like `ids` in the directions that
/// follow. `down`: the direction of the lattice nearest to gravity.
Moves move_all(State& state, grains::Occupancy& occupancy, const grains::FootprintTable& footprints,
               const grains::WallEdges& edges, lattice::Direction down,
               std::span<const std::uint32_t> ids, std::span<WallMove> walls);

}  // namespace clca::contact
