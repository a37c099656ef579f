#pragma once
// Outlets: particles that leave during a run.

#include <cstdint>

#include "clca/grains/state.hpp"

namespace clca::grains {

/// If the particle is present and wholly inside an outlet, counts it at the first such outlet and
/// returns true. The caller then removes it.
bool count_at_outlet(State& state, std::uint32_t id);

}  // namespace clca::grains
