#pragma once
// What each particle has beside it.

#include <optional>
#include <vector>

#include "clca/grains/occupancy.hpp"
#include "clca/grains/state.hpp"

namespace clca::measure {

/// Number of other particles and walls that have a site beside a site of the particle, or the same
/// one; by id, 0 for removed particles. All sides of the box count as one wall. `occupancy` belongs
/// to `state`.
std::vector<int> coordination(const grains::State& state, const grains::Occupancy& occupancy);

/// Share of the pairs of neighbouring grains that have the same axis; a third at random. None
/// without a pair.
std::optional<double> axis_order(const grains::State& state);

}  // namespace clca::measure
