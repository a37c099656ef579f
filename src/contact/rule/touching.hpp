#pragma once
// Which bodies touch, and along which normal.

#include <tuple>
#include <vector>

#include "clca/contact/state.hpp"
#include "clca/grains/footprint.hpp"
#include "contact/rule/normal_table.hpp"

namespace clca::contact {

/// A grain and what it touches.
struct Touch {
  std::uint32_t upper = 0;
  grains::Owner other = 0;
  lattice::Axial apart = {};  ///< from the upper grain to the other; of walls none
  UnitVector normal = {};     ///< towards the upper grain

  /// Contacts are swept from the top down, those of one height from the left.
  auto key(const grains::State& state) const {
    const lattice::Site site = state.particles[upper].site();
    return std::tuple(-lattice::doubled_height(site), state.lattice.wrapped(site.column), apart,
                      other);
  }
};

/// All pairs of bodies that touch, by upper grain, then by `other`.
std::vector<Touch> touches(const grains::State& state, const grains::Occupancy& occupancy,
                           const grains::FootprintTable& footprints, NormalTable& normals);

/// The walls and sides of the box that a grain touches.
std::vector<Touch> wall_touches(const grains::State& state, const grains::Occupancy& occupancy,
                                const grains::FootprintTable& footprints, std::uint32_t id);

/// Whether a grain is the upper one of two.
bool is_above(const grains::State& state, std::uint32_t one, std::uint32_t other);

/// The place of a grain among the upper ones of contacts, when these are put in order: by strips of
/// columns, every second strip first, from the top down, from the left.
std::uint64_t order_key(const grains::State& state, std::uint32_t id);

}  // namespace clca::contact
