#pragma once
// The scheme that Ogawa & Kato 1982 print, in steps of time.

#include <cstdint>

#include "clca/boltzmann/gas.hpp"
#include "clca/boltzmann/law.hpp"
#include "clca/boltzmann/scheme.hpp"

namespace clca::boltzmann {

/// Advances `gas` to `time` in whole steps and a shorter last one, or until `keep_going` returns
/// false.
/// All particles read the state before the step, so that the result does not depend on `threads`.
/// With `scheme.quasi` the particles are reordered.
/// Throws std::invalid_argument unless time step and number of partners are positive.
void advance_ogawa_kato(Gas& gas, const Law& law, const OgawaKato& scheme, std::uint64_t seed,
                        double time, int threads, const ContinueCondition& keep_going);

}  // namespace clca::boltzmann
