#include "automaton/wall_presence.hpp"

#include <algorithm>

namespace clca::automaton {

namespace {

std::vector<std::size_t> places_now(const grains::State& state, const grains::Wall& wall) {
  std::vector<std::size_t> places;
  for (const lattice::Site site : sites_now(state.lattice, wall)) {
    places.push_back(state.lattice.index(site));
  }
  return places;
}

/// Gives the places of a wall that went to the walls that cover them too.
void leave_to_others(World& world, std::vector<std::size_t>& vacated) {
  std::sort(vacated.begin(), vacated.end());
  for (std::size_t other = 0; other < world.state.walls.size(); ++other) {
    if (!world.state.walls[other].present) {
      continue;
    }
    for (const std::size_t place : places_now(world.state, world.state.walls[other])) {
      if (std::binary_search(vacated.begin(), vacated.end(), place)) {
        world.occupancy.take(place, grains::wall_code(other));
      }
    }
  }
}

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
  grains::Wall& wall = world.state.walls.at(number);
  const grains::Owner code = grains::wall_code(number);
  wall.present = false;
  world.changed = true;
  std::vector<std::size_t> vacated;
  for (const std::size_t place : places_now(world.state, wall)) {
    if (world.occupancy.has(place, code) && world.occupancy.remove(place, code)) {
      vacated.push_back(place);
    }
  }
  forget_pushes(world, code);
  leave_to_others(world, vacated);
  for (const std::size_t place : vacated) {
    if (!world.occupancy.taken(place)) {
      world.wake_upstream(place);
    }
  }
}

bool insert_wall(World& world, std::size_t number) {
  grains::Wall& wall = world.state.walls.at(number);
  if (wall.present) {
    return true;
  }
  const std::vector<std::size_t> places = places_now(world.state, wall);
  const auto moves = [&](grains::Owner owner) {
    return grains::is_wall(owner) &&
           world.state.walls[grains::wall_number(owner)].motion.has_value();
  };
  const bool barred = std::any_of(places.begin(), places.end(), [&](std::size_t place) {
    const grains::Owner owner = world.occupancy.owner(place);
    return grains::is_particle(owner) || moves(owner) ||
           (owner != grains::kFree && wall.motion.has_value());
  });
  if (barred) {
    return false;
  }
  wall.present = true;
  world.changed = true;
  for (const std::size_t place : places) {
    world.occupancy.take(place, grains::wall_code(number));
  }
  return true;
}

}  // namespace clca::automaton
