#pragma once
// Where the cases start: small and large hexagons, about 1:1, that fall or lie.

#include <cstddef>

#include "clca/grains/state.hpp"

namespace clca::bench {

/// Nothing meets anything in so many first steps of the rain.
inline constexpr int kFallingSteps = 32;

/// A rain in a box about as high as wide.
grains::State rain(std::size_t particles);

/// A rain low above the floor, as high for any number of particles: it comes to rest in about as
/// many steps, too.
grains::State low_rain(std::size_t particles);

/// The wall-removal test at any size: a bed at rest, as wide as high, behind wall 0, which has
/// more than twice as much room on its other side. At 540 particles that of
/// scenes/wall-removal.yaml.
grains::State walled_bed(std::size_t particles);

}  // namespace clca::bench
