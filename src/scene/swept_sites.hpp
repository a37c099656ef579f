#pragma once
// The sites that a moving wall sweeps over.

#include <functional>

#include "clca/lattice/swept_region.hpp"
#include "clca/scene/scene.hpp"

namespace clca::scene {

/// The region that enters the box as the wall moves; for a standing wall, the box.
lattice::SweptRegion swept_region_of(const lattice::Lattice& lattice, const Wall& wall);

/// Visits the sites of the box that the wall ever covers, each once except in a periodic box, until
/// `test` returns true. Returns whether it did.
/// Memory: the sites at the initial position. Time: these and the sites of the box.
bool any_swept_site(const lattice::Lattice& lattice, const Wall& wall,
                    const std::function<bool(lattice::Site)>& test);

}  // namespace clca::scene
