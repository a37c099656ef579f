#pragma once
// Touching bodies and their normals.

#include <span>
#include <tuple>
#include <vector>

#include "clca/contact/state.hpp"
#include "contact/rule/normal_table.hpp"
#include "contact/rule/order.hpp"
#include "contact/rule/walls.hpp"
#include "grains/internal/box.hpp"

namespace clca::contact {

/// A contact in a step.
struct Touch {
  Contact contact = {};       ///< with its present normal, and the impulses of the last step
  lattice::Axial apart = {};  ///< from the upper grain to the other; of walls none
  std::int32_t bounce = 0;    ///< the velocity with which its bodies are to separate

  /// Order of contacts: by the upper grain, then by the vector to the other one.
  using Key = std::tuple<std::int64_t, lattice::Axial, grains::Owner>;
  Key key(const grains::State& state, lattice::Direction down) const {
    return {order_key(state, down, contact.upper), apart, contact.other};
  }
};

/// The impulses if the other grain is the upper one: those along normal and tangent stay.
inline Impulse<std::int32_t> turned_over(Impulse<std::int32_t> impulse) {
  impulse.rolling *= -1;
  return impulse;
}

/// All contacts as if they were new, sorted by upper grain, then by `other`.
std::vector<Touch> touches(const grains::Box& box, lattice::Direction down, NormalTable& normals,
                           const WallVelocities& walls);

/// Contacts of a grain with walls and sides, sorted by `other`.
struct WallTouches {
  std::vector<Touch> touches;
  bool several_bodies = false;  ///< it touches two walls or sides, or more
};

/// One contact with each surface (see surfaces()), or one with each body of a surface of those that
/// move unlike.
WallTouches wall_touches(const grains::Box& box, std::uint32_t id, const WallVelocities& walls);

/// Which touch each earlier contact of a grain with a wall or a side goes on as, kNoTouch for one
/// that ends. With the most similar normal, at most 45 degrees from theirs: first those of walls as
/// one of a wall and those of sides as one of a side, then the others. Of like normals that of the
/// same body, so that it does not matter of how many a surface is made.
inline constexpr std::size_t kNoTouch = static_cast<std::size_t>(-1);
std::vector<std::size_t> followed_by(std::span<const Contact> before, std::span<const Touch> now);

}  // namespace clca::contact
