#pragma once
// One step of one wall: what it does with the particles in its way.

#include "automaton/rule/world.hpp"
#include "grains/internal/pushed_cluster.hpp"

namespace clca::automaton {

using grains::WallStep;

/// Pushes the particles in the way, and all that these stand against, along with the wall. Does
/// nothing and returns false when one of them would meet the border or another wall.
bool push_along(World& world, const WallStep& step);

/// Enters the particles in the way. Does nothing and returns false when it would meet a border or
/// another wall, make a third owner of a site, or go so deep into a particle that one move along
/// the wall's, or at 60 degrees to it, could not free it again.
bool enter(World& world, const WallStep& step);

/// Whether the wall could take the step by the rule of its kind. Changes nothing.
bool can_take(World& world, const WallStep& step);

/// Forgets those pushes of the wall for which `has_ended` holds.
template <class HasEnded>
void forget_pushes_of(World& world, std::size_t wall, HasEnded has_ended) {
  const std::vector<grains::Push> pushes = world.state.pushes;
  for (const grains::Push& push : pushes) {
    if (push.pusher == grains::wall_code(wall) && has_ended(push)) {
      world.pushes.forget(world.state, push.pushed, push.pusher);
      world.changes.particles.push_back(push.pushed);
    }
  }
}

}  // namespace clca::automaton
