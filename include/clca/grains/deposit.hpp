#pragma once
// A packing that is at rest from the beginning.

#include <span>

#include "clca/grains/fill.hpp"

namespace clca::grains {

/// Sets particles down one after another, each over a column of `region` drawn at random, where it
/// falls and rolls down on those that lie there until it rests (sequential deposition, Visscher &
/// Bolsterli 1972). Gravity points down. `counts` per species; their order is drawn. All stay
/// inside the region, whose bottom and sides hold them. What finds no room is not placed. Ids and
/// what must hold as for fill_region.
FillResult deposit_in(State& state, Occupancy& occupancy, const lattice::Rectangle& region,
                      std::span<const std::size_t> counts);

}  // namespace clca::grains
