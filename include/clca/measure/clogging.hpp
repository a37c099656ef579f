#pragma once
// Outlets that particles at rest have clogged.

#include "clca/grains/occupancy.hpp"
#include "clca/grains/state.hpp"
#include "clca/lattice/direction.hpp"

namespace clca::measure {

/// Whether particles hang over an outlet that they could have passed; at rest this means that it is
/// clogged. A particle has a way through the outlet if it could fall into it past the walls,
/// straight `down` or along the two slopes beside it, and not straight into another outlet. For the
/// largest kind with such a particle: at some place from which another one could fall into the
/// outlet now, there is no way further up, and straight above is a particle. A heap beside an open
/// orifice does not hang over it. Throws std::invalid_argument if the occupancy belongs to another
/// box, std::out_of_range if there is no such outlet.
bool clogged(const grains::State& state, const grains::Occupancy& occupancy, std::size_t outlet,
             lattice::Direction down);

}  // namespace clca::measure
