#pragma once
// How far the axes of neighbouring grains are the same, of the Baxter model.

#include <optional>

#include "clca/grains/state.hpp"

namespace clca::measure {

/// Share of the pairs of neighbouring grains that have the same axis; a third at random. None
/// without a pair.
std::optional<double> axis_order(const grains::State& state);

}  // namespace clca::measure
