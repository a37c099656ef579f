// Walls that move: docs/model.md, point 1 of "One step".

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "automaton/rule/step.hpp"

namespace clca::automaton {

namespace {

using grains::WallStep;

/// Moves a wall, and particles along with it.
void shift_wall(World& world, const WallStep& step, std::span<const std::uint32_t> particles) {
  for (const std::size_t index : step.vacated) {
    world.occupancy.remove_owner(index, grains::wall_code(step.wall));
  }
  world.move_together(particles, step.direction);
  for (const std::size_t index : step.entered) {
    world.occupancy.add_owner(index, grains::wall_code(step.wall));
  }
}

/// Undoes a step of the wall alone.
void undo_step(World& world, WallStep step) {
  std::swap(step.entered, step.vacated);
  shift_wall(world, step, {});
}

/// Pushes the particles in the way, and all that these stand against, along with the wall. Does
/// nothing and returns false when one of them would meet the border or another wall.
bool push_along(World& world, const WallStep& step) {
  const auto ids = pushed_particles(world.box, step);
  if (ids) {
    shift_wall(world, step, *ids);
  }
  return ids.has_value();
}

/// Moves the sites of a wall onto the particles in the way and returns these, each once. Does
/// nothing and returns none when it would meet a border or another wall, make a third owner of a
/// site, or go so deep into a particle that one move along the wall's, or at 60 degrees to it,
/// could not free it again.
std::optional<std::vector<std::uint32_t>> move_onto(World& world, const WallStep& step) {
  std::vector<std::uint32_t> ids;
  for (const std::size_t index : step.entered) {
    const grains::Owner owner = world.occupancy.owner(index);
    if (grains::is_particle(owner) && world.occupancy.second_owner(index) == grains::kFree) {
      ids.push_back(grains::particle_id(owner));
    } else if (owner != grains::kFree) {
      return std::nullopt;
    }
  }
  std::ranges::sort(ids);
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  shift_wall(world, step, {});
  const std::array ways = {step.direction, rotated(step.direction, 1), rotated(step.direction, -1)};
  if (!std::ranges::all_of(ids, [&](std::uint32_t id) {
        return can_leave(world, world.state.particles[id], grains::wall_code(step.wall), ways);
      })) {
    undo_step(world, step);
    return std::nullopt;
  }
  return ids;
}

/// Moves a wall onto the particles in the way, if it may, and keeps its pushes true.
bool overlap_along(World& world, const WallStep& step) {
  const auto ids = move_onto(world, step);
  if (!ids) {
    return false;
  }
  for (const std::uint32_t id : *ids) {
    world.record_push({.pushed = id,
                       .pusher = grains::wall_code(step.wall),
                       .source = static_cast<std::uint32_t>(step.wall),
                       .direction = step.direction});
  }
  const std::vector<grains::Push> pushes = world.state.pushes;
  for (const grains::Push& push : pushes) {
    if (push.pusher == grains::wall_code(step.wall) &&
        !has_owner(world.overlaps_at(push.pushed, world.state.particles[push.pushed]),
                   push.pusher)) {
      world.forget_push(push.pushed, push.pusher);
      world.changes.changed_particles.push_back(push.pushed);
    }
  }
  return true;
}

/// Whether the wall could take the step by the rule of its kind. Changes nothing.
bool can_take(World& world, const WallStep& step) {
  if (!world.state.walls[step.wall].lets_overlap()) {
    return pushed_particles(world.box, step).has_value();
  }
  const bool can = move_onto(world, step).has_value();
  if (can) {
    undo_step(world, step);
  }
  return can;
}

}  // namespace

bool advance_walls(World& world) {
  bool moved = false;
  world.moved_by_walls.clear();
  for (std::size_t number = 0; number < world.state.walls.size(); ++number) {
    grains::Wall& wall = world.state.walls[number];
    if (!wall.in_motion()) {
      continue;
    }
    const int desired = desired_step(*wall.motion, wall.travel);
    bool done = false;
    if (desired != 0) {
      const WallStep step = world.box.wall_edges.wall_step(world.state, number, desired);
      done = wall.lets_overlap() ? overlap_along(world, step) : push_along(world, step);
      if (done) {
        std::vector<std::size_t>& vacated = world.changes.vacated_sites;
        vacated.insert(vacated.end(), step.vacated.begin(), step.vacated.end());
        world.changes.by_others = true;
        moved = true;
      }
    }
    record_step(*wall.motion, wall.travel, desired, done, world.state.step);
  }
  return moved;
}

bool walls_are_still(World& world) {
  for (std::size_t number = 0; number < world.state.walls.size(); ++number) {
    const grains::Wall& wall = world.state.walls[number];
    if (!wall.in_motion() || is_over(*wall.motion, wall.travel)) {
      continue;
    }
    const int desired = pending_step(*wall.motion, wall.travel);
    if (desired == 0 || !wall.travel.stalled_since ||
        can_take(world, world.box.wall_edges.wall_step(world.state, number, desired))) {
      return false;
    }
  }
  return true;
}

}  // namespace clca::automaton
