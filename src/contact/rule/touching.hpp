#pragma once
// Touching bodies and their normals.

#include <tuple>
#include <vector>

#include "clca/contact/state.hpp"
#include "contact/rule/normal_table.hpp"
#include "contact/rule/order.hpp"
#include "grains/internal/box.hpp"

namespace clca::contact {

/// A contact in a step.
struct Touch {
  Contact contact = {};       ///< with its present normal, and the impulses of the last step
  lattice::Axial apart = {};  ///< from the upper grain to the other; of walls none
  bool is_new = true;         ///< not there in the last step

  /// Order of new contacts: from the top down, at equal height from the left.
  using Key = std::tuple<int, int, lattice::Axial, grains::Owner>;
  Key key(const grains::State& state, lattice::Direction down) const {
    const grains::Particle& grain = state.particles[contact.upper];
    const int column = state.lattice.wrapped(grain.column);
    return {place_along(down, {column, grain.row}), column, apart, contact.other};
  }
};

/// The impulses if the other grain is the upper one: those along normal and tangent stay.
inline Impulse<std::int32_t> turned_over(Impulse<std::int32_t> impulse) {
  impulse.rolling *= -1;
  return impulse;
}

/// All contacts as if they were new, sorted by upper grain, then by `other`.
std::vector<Touch> touches(const grains::Box& box, lattice::Direction down, NormalTable& normals);

/// The same with the walls and sides that a grain touches.
std::vector<Touch> wall_touches(const grains::Box& box, std::uint32_t id);

}  // namespace clca::contact
