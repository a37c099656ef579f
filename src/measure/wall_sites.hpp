#pragma once
// The sites of all walls.

#include <vector>

#include "clca/grains/state.hpp"

namespace clca::measure {

/// Sites of the present walls, sorted, without duplicates.
std::vector<lattice::Site> wall_sites(const grains::State& state);

}  // namespace clca::measure
