#pragma once
// Occupancy is looked up by the places of a state.

#include <stdexcept>

#include "clca/grains/occupancy.hpp"
#include "clca/grains/state.hpp"

namespace clca::measure {

/// Throws std::invalid_argument for that of another box.
inline void check_occupancy(const grains::State& state, const grains::Occupancy& occupancy) {
  if (occupancy.places() != state.lattice.memory_size()) {
    throw std::invalid_argument("the occupancy is that of another box");
  }
}

}  // namespace clca::measure
