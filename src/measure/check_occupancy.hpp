#pragma once
// Occupancy is looked up by the places of a state.

#include <stdexcept>

#include "clca/automaton/occupancy.hpp"
#include "clca/automaton/state.hpp"

namespace clca::measure {

/// Throws std::invalid_argument for that of another box.
inline void check_occupancy(const automaton::State& state, const automaton::Occupancy& occupancy) {
  if (occupancy.places() != state.lattice.memory_size()) {
    throw std::invalid_argument("the occupancy is that of another box");
  }
}

}  // namespace clca::measure
