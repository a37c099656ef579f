#include "automaton/wall_mover.hpp"

namespace clca::automaton {

void WallMover::advance(World& world, StepReport& report) {
  world.carried.clear();
  for (std::size_t number = 0; number < world.state.walls.size(); ++number) {
    grains::Wall& wall = world.state.walls[number];
    if (!wall.motion || !wall.present || !wall.travel.active) {
      continue;
    }
    const int wished = wish(*wall.motion, wall.travel);
    bool done = false;
    if (wished != 0) {
      const grains::WallStep step = edges_.step_of(world.state, number, wished);
      done = wall.passive == grains::Passive::rigid ? push_along(world, step) : enter(world, step);
      ++(done ? report.walls_moved : report.walls_stalled);
    }
    take_step(*wall.motion, wall.travel, wished, done, world.state.step);
  }
}

void WallMover::end_step(World& world, bool particles_moved) {
  for (grains::Wall& wall : world.state.walls) {
    if (wall.motion && wall.present && wall.travel.active) {
      grains::end_step(*wall.motion, wall.travel, particles_moved);
    }
  }
}

bool WallMover::is_still(World& world) const {
  for (std::size_t number = 0; number < world.state.walls.size(); ++number) {
    const grains::Wall& wall = world.state.walls[number];
    if (!wall.motion || !wall.present || !wall.travel.active ||
        is_over(*wall.motion, wall.travel)) {
      continue;
    }
    const int wished = lasting_wish(*wall.motion, wall.travel);
    if (wished == 0 || !wall.travel.stalled_since ||
        can_take(world, edges_.step_of(world.state, number, wished))) {
      return false;
    }
  }
  return true;
}

}  // namespace clca::automaton
