#pragma once
// In words, how one state differs from another.

#include <string>

#include "clca/grains/state.hpp"

namespace clca::testing {

/// The first walls, particles and pushes that differ; empty when nothing does.
std::string difference(const grains::State& found, const grains::State& expected);

}  // namespace clca::testing
