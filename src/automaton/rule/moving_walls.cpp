#include "automaton/rule/moving_walls.hpp"

#include "automaton/rule/wall_push.hpp"

namespace clca::automaton {

namespace {

bool is_active(const grains::Wall& wall) {
  return wall.motion && wall.present && wall.travel.active;
}

}  // namespace

WallMoves advance_walls(World& world) {
  WallMoves moves;
  world.carried.clear();
  for (std::size_t number = 0; number < world.state.walls.size(); ++number) {
    grains::Wall& wall = world.state.walls[number];
    if (!is_active(wall)) {
      continue;
    }
    const int desired = desired_step(*wall.motion, wall.travel);
    bool done = false;
    if (desired != 0) {
      const grains::WallStep step = world.box.edges.step_of(world.state, number, desired);
      done = wall.passive == grains::Passive::rigid ? push_along(world, step) : enter(world, step);
      ++(done ? moves.moved : moves.stalled);
    }
    take_step(*wall.motion, wall.travel, desired, done, world.state.step);
  }
  return moves;
}

bool walls_are_still(World& world) {
  for (std::size_t number = 0; number < world.state.walls.size(); ++number) {
    const grains::Wall& wall = world.state.walls[number];
    if (!is_active(wall) || is_over(*wall.motion, wall.travel)) {
      continue;
    }
    const int desired = pending_step(*wall.motion, wall.travel);
    if (desired == 0 || !wall.travel.stalled_since ||
        can_take(world, world.box.edges.step_of(world.state, number, desired))) {
      return false;
    }
  }
  return true;
}

void end_step_of_walls(World& world, bool particles_moved) {
  for (grains::Wall& wall : world.state.walls) {
    if (is_active(wall)) {
      end_step(*wall.motion, wall.travel, particles_moved);
    }
  }
}

}  // namespace clca::automaton
