#pragma once
// In words, how one state differs from another.

#include <string>

#include "clca/automaton/state.hpp"

namespace clca::testing {

/// The first walls, particles and pushes that differ; empty when nothing does.
std::string difference(const automaton::State& found, const automaton::State& expected);

}  // namespace clca::testing
