#include "automaton/rule/moving_walls.hpp"

#include <algorithm>
#include <array>
#include <optional>

#include "automaton/rule/overlap_change.hpp"

namespace clca::automaton {

namespace {

using grains::WallStep;

/// The particles that it pushes; none if the way is barred.
std::optional<std::vector<std::uint32_t>> pushed(const World& world, const WallStep& step) {
  return grains::pushed_particles(world.box, step,
                                  [&](std::uint32_t id) { return world.pushes.overlapping(id); });
}

void leave(World& world, const WallStep& step) {
  for (const std::size_t index : step.leaves) {
    world.occupancy.remove(index, grains::wall_code(step.wall));
  }
}

bool may_enter(const World& world, const WallStep& step) {
  return std::ranges::all_of(step.enters, [&](std::size_t index) {
    const grains::Owner owner = world.occupancy.owner(index);
    return owner == grains::kFree ||
           (grains::is_particle(owner) && world.occupancy.second_owner(index) == grains::kFree);
  });
}

void move_sites(World& world, const WallStep& step) {
  leave(world, step);
  for (const std::size_t index : step.enters) {
    world.occupancy.add(index, grains::wall_code(step.wall));
  }
}

void move_sites_back(World& world, const WallStep& step) {
  for (const std::size_t index : step.enters) {
    world.occupancy.remove(index, grains::wall_code(step.wall));
  }
  for (const std::size_t index : step.leaves) {
    world.occupancy.add(index, grains::wall_code(step.wall));
  }
}

/// The particles at the sites that a wall has entered, each once.
std::vector<std::uint32_t> touched(const World& world, const WallStep& step) {
  std::vector<std::uint32_t> ids;
  for (const std::size_t index : step.enters) {
    const grains::Owner other = world.occupancy.second_owner(index);  // a wall comes first
    if (grains::is_particle(other)) {
      ids.push_back(grains::particle_id(other));
    }
  }
  std::ranges::sort(ids);
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  return ids;
}

/// Whether these particles could be clear of the wall after one step along its way or beside it.
bool is_shallow(const World& world, const WallStep& step, const std::vector<std::uint32_t>& ids) {
  const std::array ways = {step.direction, rotated(step.direction, 1), rotated(step.direction, -1)};
  return std::ranges::all_of(ids, [&](std::uint32_t id) {
    return can_leave(world, world.state.particles[id], grains::wall_code(step.wall), ways);
  });
}

/// What the wall has left behind, once the particles stand where they will.
void note_left(World& world, const WallStep& step) {
  world.changes.vacated.insert(world.changes.vacated.end(), step.leaves.begin(), step.leaves.end());
  world.changes.by_others = true;
}

/// Pushes the particles in the way, and all that these stand against, along with the wall. Does
/// nothing and returns false when one of them would meet the border or another wall.
bool push_along(World& world, const WallStep& step) {
  const auto ids = pushed(world, step);
  if (!ids) {
    return false;
  }
  leave(world, step);
  world.move_together(*ids, step.direction);
  for (const std::size_t index : step.enters) {
    world.occupancy.add(index, grains::wall_code(step.wall));
  }
  note_left(world, step);
  return true;
}

/// Enters the particles in the way. Does nothing and returns false when it would meet a border or
/// another wall, make a third owner of a site, or go so deep into a particle that one move along
/// the wall's, or at 60 degrees to it, could not free it again.
bool enter(World& world, const WallStep& step) {
  if (!may_enter(world, step)) {
    return false;
  }
  move_sites(world, step);
  const std::vector<std::uint32_t> ids = touched(world, step);
  if (!is_shallow(world, step, ids)) {
    move_sites_back(world, step);
    return false;
  }
  for (const std::uint32_t id : ids) {
    world.pushes.record(world.state, {.pushed = id,
                                      .pusher = grains::wall_code(step.wall),
                                      .source = static_cast<std::uint32_t>(step.wall),
                                      .direction = step.direction});
  }
  const std::vector<grains::Push> pushes = world.state.pushes;
  for (const grains::Push& push : pushes) {
    if (push.pusher == grains::wall_code(step.wall) &&
        !shares(world.overlaps(push.pushed, world.state.particles[push.pushed]), push.pusher)) {
      world.forget_push(push.pushed, push.pusher);
      world.changes.particles.push_back(push.pushed);
    }
  }
  note_left(world, step);
  return true;
}

/// Whether the wall could take the step by the rule of its kind. Changes nothing.
bool can_take(World& world, const WallStep& step) {
  if (!world.state.walls[step.wall].lets_overlap()) {
    return pushed(world, step).has_value();
  }
  if (!may_enter(world, step)) {
    return false;
  }
  move_sites(world, step);
  const bool shallow = is_shallow(world, step, touched(world, step));
  move_sites_back(world, step);
  return shallow;
}

}  // namespace

WallMoves advance_walls(World& world) {
  WallMoves moves;
  world.carried.clear();
  for (std::size_t number = 0; number < world.state.walls.size(); ++number) {
    grains::Wall& wall = world.state.walls[number];
    if (!wall.in_motion()) {
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
    if (!wall.in_motion() || is_over(*wall.motion, wall.travel)) {
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
    if (wall.in_motion()) {
      end_step(*wall.motion, wall.travel, particles_moved);
    }
  }
}

}  // namespace clca::automaton
