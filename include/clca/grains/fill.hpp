#pragma once
// Placing particles at random where there is room.

#include <cstddef>
#include <span>
#include <vector>

#include "clca/grains/occupancy.hpp"
#include "clca/grains/state.hpp"
#include "clca/lattice/region.hpp"

namespace clca::grains {

/// How many particles a fill has placed.
struct FillResult {
  std::vector<std::size_t> placed;  ///< per species
  bool complete = true;
};

/// Throws std::invalid_argument unless there is one count for each species.
void check_counts(const State& state, std::span<const std::size_t> counts);

/// Places `counts` (per species) particles at random in free sites of `region`, larger species
/// first, each in a random orientation. They are appended to `state` and entered in `occupancy`;
/// their ids follow the columns from the left, upwards. A species that no longer fits anywhere is
/// placed in part. See check_counts and lattice::check for what must hold.
FillResult fill_region(State& state, Occupancy& occupancy, const lattice::Rectangle& region,
                       std::span<const std::size_t> counts);

}  // namespace clca::grains
