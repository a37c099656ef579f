#include "automaton/wall_presence.hpp"

#include "clca/grains/wall.hpp"

namespace clca::automaton {

namespace {

void forget_pushes(World& world, grains::Owner code) {
  const std::vector<grains::Push> pushes = world.state.pushes;
  for (const grains::Push& push : pushes) {
    if (push.pusher == code) {
      world.pushes.forget(world.state, push.pushed, code);
      world.awake.insert(push.pushed);
    }
  }
}

}  // namespace

void remove_wall(World& world, std::size_t number) {
  const std::vector<std::size_t> vacated =
      grains::remove_wall(world.state, world.occupancy, number);
  forget_pushes(world, grains::wall_code(number));
  world.changed = true;
  for (const std::size_t place : vacated) {
    world.wake_upstream(place);
  }
}

bool insert_wall(World& world, std::size_t number) {
  const bool was_there = world.state.walls.at(number).present;
  const bool is_there = grains::insert_wall(world.state, world.occupancy, number);
  world.changed = world.changed || is_there != was_there;
  return is_there;
}

}  // namespace clca::automaton
