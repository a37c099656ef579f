#pragma once
// Checks that an occupancy belongs to a state.

#include <stdexcept>

#include "clca/grains/occupancy.hpp"
#include "clca/grains/state.hpp"

namespace clca::measure {

/// Throws std::invalid_argument if it belongs to another box.
inline void check_occupancy(const grains::State& state, const grains::Occupancy& occupancy) {
  if (occupancy.index_count() != state.lattice.index_count()) {
    throw std::invalid_argument("the occupancy is that of another box");
  }
}

}  // namespace clca::measure
