#pragma once
// Touching bodies and their normals.

#include <tuple>
#include <vector>

#include "clca/contact/state.hpp"
#include "contact/rule/normal_table.hpp"
#include "contact/rule/order.hpp"
#include "grains/internal/footprint.hpp"
#include "grains/internal/occupancy_table.hpp"

namespace clca::contact {

/// A touching pair: a grain and another body.
struct Touch {
  std::uint32_t upper = 0;
  grains::Owner other = 0;
  lattice::Axial apart = {};  ///< from the upper grain to the other; of walls none
  UnitVector normal = {};     ///< towards the upper grain

  /// Sweep order: from the top down, at equal height from the left.
  using Key = std::tuple<int, int, lattice::Axial, grains::Owner>;
  Key key(const grains::State& state, lattice::Direction down) const {
    const grains::Particle& grain = state.particles[upper];
    const int column = state.lattice.wrapped(grain.column);
    return {place_along(down, {column, grain.row}), column, apart, other};
  }
};

/// All touching pairs, sorted by upper grain, then by `other`.
std::vector<Touch> touches(const grains::State& state, const grains::OccupancyTable& occupancy,
                           const grains::FootprintTable& footprints, lattice::Direction down,
                           NormalTable& normals);

/// The walls and sides that a grain touches.
std::vector<Touch> wall_touches(const grains::State& state, const grains::OccupancyTable& occupancy,
                                const grains::FootprintTable& footprints, std::uint32_t id);

}  // namespace clca::contact
