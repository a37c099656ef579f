#include "automaton/rule/moving_walls.hpp"

#include "grains/internal/wall.hpp"

namespace clca::automaton {

namespace {

bool is_active(const grains::Wall& wall) {
  return wall.motion && wall.present && wall.travel.active;
}

}  // namespace

void MovingWalls::advance(World& world, StepReport& report) const {
  world.carried.clear();
  for (std::size_t number = 0; number < world.state.walls.size(); ++number) {
    grains::Wall& wall = world.state.walls[number];
    if (!is_active(wall)) {
      continue;
    }
    const int desired = desired_step(*wall.motion, wall.travel);
    bool done = false;
    if (desired != 0) {
      const grains::WallStep step = edges_.step_of(world.state, number, desired);
      done = wall.passive == grains::Passive::rigid ? push_along(world, step) : enter(world, step);
      ++(done ? report.walls_moved : report.walls_stalled);
    }
    take_step(*wall.motion, wall.travel, desired, done, world.state.step);
  }
}

void MovingWalls::end_step(World& world, bool particles_moved) {
  for (grains::Wall& wall : world.state.walls) {
    if (is_active(wall)) {
      grains::end_step(*wall.motion, wall.travel, particles_moved);
    }
  }
}

bool MovingWalls::is_still(World& world) const {
  for (std::size_t number = 0; number < world.state.walls.size(); ++number) {
    const grains::Wall& wall = world.state.walls[number];
    if (!is_active(wall) || is_over(*wall.motion, wall.travel)) {
      continue;
    }
    const int desired = pending_step(*wall.motion, wall.travel);
    if (desired == 0 || !wall.travel.stalled_since ||
        can_take(world, edges_.step_of(world.state, number, desired))) {
      return false;
    }
  }
  return true;
}

void remove_wall(World& world, std::size_t number) {
  const std::vector<std::size_t> vacated =
      grains::remove_wall(world.state, world.occupancy, number);
  forget_pushes_of(world, number, [](const grains::Push&) { return true; });
  world.changes.vacated.insert(world.changes.vacated.end(), vacated.begin(), vacated.end());
  world.changes.by_others = true;
}

bool insert_wall(World& world, std::size_t number) {
  const bool was_there = world.state.walls.at(number).present;
  const bool is_there = grains::insert_wall(world.state, world.occupancy, number);
  world.changes.by_others = world.changes.by_others || is_there != was_there;
  return is_there;
}

}  // namespace clca::automaton
