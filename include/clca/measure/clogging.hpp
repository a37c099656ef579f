#pragma once
// Outlets that particles at rest have clogged.

#include "clca/grains/occupancy.hpp"
#include "clca/grains/state.hpp"
#include "clca/lattice/direction.hpp"

namespace clca::measure {

/// Whether particles are held up above an outlet that they could have passed; at rest this means
/// that it is clogged. A particle has a way through the outlet if it could fall into it past the
/// walls, straight `down` or along the two slopes beside it, and not straight into another outlet.
/// Take the largest kind with such a particle, and all sites from which another one could fall
/// into the outlet now. At one of them, below the top of the box, there is no way further up, with
/// particles in one of the three; or none of them is at the top of the box, and without particles
/// one would be. A heap beside an open orifice is not held up. Throws std::invalid_argument if the
/// occupancy belongs to another box, std::out_of_range if there is no such outlet.
bool clogged(const grains::State& state, const grains::Occupancy& occupancy, std::size_t outlet,
             lattice::Direction down);

}  // namespace clca::measure
