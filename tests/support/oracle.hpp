#pragma once
// The update rule written down as plainly as it can be: the oracle for the real thing.

#include "clca/automaton/rules.hpp"
#include "clca/grains/state.hpp"

namespace clca::testing {

/// One step of a state without sources and outlets. Every particle is looked at, movers have their
/// turn one after the other. Returns how many moved.
std::size_t oracle_step(grains::State& state, const automaton::Rules& rules);

/// Sum of the heights of all particles against gravity, in half lattice spacings.
long long potential(const grains::State& state, const automaton::Rules& rules);

}  // namespace clca::testing
