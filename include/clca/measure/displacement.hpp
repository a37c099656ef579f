#pragma once
// How far particles have come since the stage began (State::origins). What looks at them throws
// std::invalid_argument unless each particle has one.

#include <optional>
#include <vector>

#include "clca/grains/state.hpp"

namespace clca::measure {

/// Distance of each particle from its origin by id, in lattice spacings; 0 for removed ones.
std::vector<double> displacements(const grains::State& state);

/// Share of the particles still present that are further than `distance` (lattice spacings) from
/// their origin; 0 where none is present. Throws std::invalid_argument also for NaN.
double moved_share(const grains::State& state, double distance);

/// Diameter of the smallest kind (lattice::Shape::diameter); infinite where there are none.
double smallest_diameter(const grains::State& state);

/// How far the material has spread beyond the columns it stood in at its origins, in lattice
/// spacings; the larger of both sides, negative when it has drawn back from both.
struct Runout {
  double front = 0;       ///< of the outermost site
  double percent_99 = 0;  ///< of the position that 99 % of the sites do not pass on that side
};

/// Nothing for an empty box.
std::optional<Runout> runout(const grains::State& state);

}  // namespace clca::measure
