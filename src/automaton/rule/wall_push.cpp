#include "automaton/rule/wall_push.hpp"

#include <algorithm>
#include <array>

#include "automaton/rule/overlap_change.hpp"

namespace clca::automaton {

namespace {

using grains::PushedCluster;

PushedCluster cluster_of(const World& world, const WallStep& step) {
  return {world.box, step};
}

/// Returns false when the way is barred.
bool gather(const World& world, PushedCluster& cluster) {
  return cluster.gather([&](std::uint32_t id) { return world.pushes.overlapping(id); });
}

void leave(World& world, const WallStep& step) {
  for (const std::size_t index : step.leaves) {
    world.occupancy.remove(index, grains::wall_code(step.wall));
  }
}

bool may_enter(const World& world, const WallStep& step) {
  return std::all_of(step.enters.begin(), step.enters.end(), [&](std::size_t index) {
    const grains::Owner owner = world.occupancy.owner(index);
    return owner == grains::kFree ||
           (grains::is_particle(owner) && world.occupancy.second_owner(index) == grains::kFree);
  });
}

void stand_ahead(World& world, const WallStep& step) {
  leave(world, step);
  for (const std::size_t index : step.enters) {
    world.occupancy.add(index, grains::wall_code(step.wall));
  }
}

void stand_back(World& world, const WallStep& step) {
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
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  return ids;
}

/// Whether these particles could be clear of the wall after one step along its way or beside it.
bool is_shallow(const World& world, const WallStep& step, const std::vector<std::uint32_t>& ids) {
  const std::array ways = {step.direction, rotated(step.direction, 1), rotated(step.direction, -1)};
  return std::all_of(ids.begin(), ids.end(), [&](std::uint32_t id) {
    return can_leave(world, world.state.particles[id], grains::wall_code(step.wall), ways);
  });
}

/// What the wall has left behind, once the particles stand where they will.
void note_left(World& world, const WallStep& step) {
  world.changes.vacated.insert(world.changes.vacated.end(), step.leaves.begin(), step.leaves.end());
  world.changes.by_others = true;
}

}  // namespace

bool push_along(World& world, const WallStep& step) {
  PushedCluster cluster = cluster_of(world, step);
  if (!gather(world, cluster)) {
    return false;
  }
  leave(world, step);
  world.move_together(cluster.ids(), step.direction);
  for (const std::size_t index : step.enters) {
    world.occupancy.add(index, grains::wall_code(step.wall));
  }
  note_left(world, step);
  return true;
}

bool enter(World& world, const WallStep& step) {
  if (!may_enter(world, step)) {
    return false;
  }
  stand_ahead(world, step);
  const std::vector<std::uint32_t> ids = touched(world, step);
  if (!is_shallow(world, step, ids)) {
    stand_back(world, step);
    return false;
  }
  for (const std::uint32_t id : ids) {
    world.pushes.record(world.state, {.pushed = id,
                                      .pusher = grains::wall_code(step.wall),
                                      .source = static_cast<std::uint32_t>(step.wall),
                                      .direction = step.direction});
  }
  forget_pushes_of(world, step.wall, [&](const grains::Push& push) {
    const std::vector<Overlap> all =
        world.overlaps(push.pushed, world.state.particles[push.pushed]);
    return std::none_of(all.begin(), all.end(),
                        [&](const Overlap& overlap) { return overlap.owner == push.pusher; });
  });
  note_left(world, step);
  return true;
}

bool can_take(World& world, const WallStep& step) {
  if (!world.state.walls[step.wall].lets_overlap()) {
    PushedCluster cluster = cluster_of(world, step);
    return gather(world, cluster);
  }
  if (!may_enter(world, step)) {
    return false;
  }
  stand_ahead(world, step);
  const bool shallow = is_shallow(world, step, touched(world, step));
  stand_back(world, step);
  return shallow;
}

}  // namespace clca::automaton
