#pragma once
// A packing that is at rest from the beginning.

#include <span>

#include "clca/automaton/automaton.hpp"
#include "clca/automaton/occupancy.hpp"

namespace clca::automaton {

/// Sets particles down one after another, each over a column of `region` drawn at random, where it
/// falls and rolls down on those that lie there until it rests (sequential deposition, Visscher &
/// Bolsterli 1972). `counts` per species; their order is drawn. All stay inside the region, whose
/// bottom and sides hold them. What finds no room is not placed. Throws std::invalid_argument
/// unless gravity points down.
FillResult deposit_in(State& state, Occupancy& occupancy, const lattice::Rectangle& region,
                      std::span<const std::size_t> counts);

}  // namespace clca::automaton
