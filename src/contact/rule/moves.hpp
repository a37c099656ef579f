#pragma once
// Moves of one step, site by site where there is room.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "clca/contact/state.hpp"
#include "clca/grains/footprint.hpp"
#include "contact/rule/walls.hpp"
#include "grains/wall_step.hpp"

namespace clca::contact {

/// Of moves in a step: down first, up last; of a pair at the same angle the one that a coin names.
std::array<lattice::Direction, lattice::kDirectionCount> order_of_directions(
    const grains::State& state);

/// What moves of a step have changed: ids of grains, some more than once.
struct Moves {
  std::vector<std::uint32_t> moved;
  std::vector<std::uint32_t> beside_walls;  ///< beside places that walls have entered or left
};

/// Moves each of the grains `ids` by a site in every direction in which its remainder asks for it
/// and its way is free; one that follows another goes with it. Each of the walls takes the move
/// that it wants, and takes along what is in its way, and what is in the way of that, unless the
/// border or another wall is. What has been pushed may move like `ids` in the directions that
/// follow.
Moves move_all(State& state, grains::Occupancy& occupancy, const grains::FootprintTable& footprints,
               const grains::WallEdges& edges, std::span<const std::uint32_t> ids,
               std::span<WallMove> walls);

}  // namespace clca::contact
