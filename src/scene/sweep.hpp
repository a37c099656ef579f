#pragma once
// The way of a moving wall through the box.

#include <functional>

#include "clca/lattice/catchment.hpp"
#include "clca/scene/scene.hpp"

namespace clca::scene {

/// The sites that come into the box as the wall moves; of a wall that stands, the box.
lattice::Catchment catchment_of(const lattice::Lattice& lattice, const Wall& wall);

/// Goes through the sites of the box that the wall covers somewhere on its way, each once but for
/// a periodic box, until `test` holds for one. Returns whether it did. Takes memory for the sites
/// at home, no more, and time for them and the sites of the box.
bool meets(const lattice::Lattice& lattice, const Wall& wall,
           const std::function<bool(lattice::Site)>& test);

}  // namespace clca::scene
