#pragma once
// Outlets: particles that leave during a run.

#include <cstdint>

#include "clca/grains/state.hpp"

namespace clca::grains {

/// Counts the particle at the first outlet that it lies wholly inside, if it is present and there
/// is one. Tells whether there is: the caller then takes the particle away.
bool count_at_outlet(State& state, std::uint32_t id);

}  // namespace clca::grains
