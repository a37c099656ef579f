#pragma once
// Displacements since the start of the stage (State::origins).
// All functions throw std::invalid_argument unless each particle has an origin.

#include <optional>
#include <vector>

#include "clca/grains/state.hpp"

namespace clca::measure {

/// Distance of each particle from its origin by id, in lattice spacings; 0 for removed ones.
std::vector<double> displacements(const grains::State& state);

/// Share of the present particles further than `distance` (lattice spacings) from their origin;
/// none if none is present. Throws std::invalid_argument for NaN.
std::optional<double> moved_share(const grains::State& state, double distance);

/// Diameter of the smallest kind (lattice::Shape::diameter); infinite if there are none.
double smallest_diameter(const grains::State& state);

/// How far the material has spread beyond the columns of its origins, lattice spacings. The larger
/// of both sides; negative if it receded on both.
struct Runout {
  double front = 0;       ///< of the outermost site
  double percent_99 = 0;  ///< of the 99th percentile of the sites on that side
  bool at_side = false;   ///< the front is at a side of the box, which ends it
};

/// None for an empty box.
std::optional<Runout> runout(const grains::State& state);

}  // namespace clca::measure
