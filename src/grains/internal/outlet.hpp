#pragma once
// Outlets: particles that leave during a run.

#include <cstdint>

#include "clca/grains/state.hpp"

namespace clca::grains {

/// Index of the first outlet that the particle lies wholly inside; the number of outlets if there
/// is none.
std::size_t outlet_around(const State& state, const Particle& particle);

/// If the particle is present and wholly inside an outlet, counts it at the first such outlet and
/// returns true. The caller then removes it.
bool count_at_outlet(State& state, std::uint32_t id);

}  // namespace clca::grains
