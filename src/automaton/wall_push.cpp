#include "automaton/wall_push.hpp"

#include <algorithm>
#include <array>

#include "automaton/overlap_change.hpp"

namespace clca::automaton {

namespace {

/// Particles that have to go along with a wall.
class Train {
 public:
  Train(const World& world, const WallStep& step)
      : world_(world), step_(step), aboard_(world.state.particles.size(), false) {}

  /// Returns false when the way is barred.
  bool gather() {
    for (const std::size_t place : step_.enters) {
      take(place);
    }
    for (std::size_t i = 0; i < ids_.size() && !barred_; ++i) {
      const grains::Particle& particle = world_.state.particles[ids_[i]];
      const grains::Footprint& footprint = world_.footprints.of(particle);
      const auto visit = [&](std::size_t place) { take(place); };
      world_.for_each_place(particle, footprint.lead[index_of(step_.direction)], visit);
      if (world_.pushes.engaged(ids_[i])) {  // whoever overlaps with it
        world_.for_each_place(particle, visit);
      }
    }
    return !barred_;
  }

  const std::vector<std::uint32_t>& ids() const { return ids_; }

 private:
  void take(std::size_t place) {
    take_owner(world_.occupancy.owner(place));
    take_owner(world_.occupancy.second_owner(place));
  }
  void take_owner(grains::Owner owner) {
    if (grains::is_particle(owner)) {
      const auto id = static_cast<std::uint32_t>(owner);
      if (!aboard_[id]) {
        aboard_[id] = true;
        ids_.push_back(id);
      }
    } else {
      barred_ = barred_ || (owner != grains::kFree && owner != grains::wall_code(step_.wall));
    }
  }

  const World& world_;
  const WallStep& step_;
  std::vector<bool> aboard_;
  std::vector<std::uint32_t> ids_;
  bool barred_ = false;
};

void leave(World& world, const WallStep& step) {
  for (const std::size_t place : step.leaves) {
    world.occupancy.remove(place, grains::wall_code(step.wall));
  }
}

void wake_behind(World& world, const WallStep& step) {
  for (const std::size_t place : step.leaves) {
    if (!world.occupancy.taken(place)) {
      world.wake_upstream(place);
    }
  }
}

bool may_enter(const World& world, const WallStep& step) {
  return std::all_of(step.enters.begin(), step.enters.end(), [&](std::size_t place) {
    const grains::Owner owner = world.occupancy.owner(place);
    return owner == grains::kFree ||
           (grains::is_particle(owner) && world.occupancy.second_owner(place) == grains::kFree);
  });
}

void stand_ahead(World& world, const WallStep& step) {
  leave(world, step);
  for (const std::size_t place : step.enters) {
    world.occupancy.add(place, grains::wall_code(step.wall));
  }
}

void stand_back(World& world, const WallStep& step) {
  for (const std::size_t place : step.enters) {
    world.occupancy.remove(place, grains::wall_code(step.wall));
  }
  for (const std::size_t place : step.leaves) {
    world.occupancy.add(place, grains::wall_code(step.wall));
  }
}

/// The particles at the places that a wall has entered, each once.
std::vector<std::uint32_t> touched(const World& world, const WallStep& step) {
  std::vector<std::uint32_t> ids;
  for (const std::size_t place : step.enters) {
    const grains::Owner other = world.occupancy.second_owner(place);  // a wall comes first
    if (grains::is_particle(other)) {
      ids.push_back(static_cast<std::uint32_t>(other));
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

/// Forgets the wall's pushes on particles that it has left behind.
void forget_behind(World& world, const WallStep& step) {
  std::vector<std::uint32_t> pushed;
  for (const grains::Push& push : world.state.pushes) {
    if (push.pusher == grains::wall_code(step.wall)) {
      pushed.push_back(push.pushed);
    }
  }
  for (const std::uint32_t id : pushed) {
    const std::vector<Overlap> overlaps = world.overlaps(id, world.state.particles[id]);
    const bool lasts = std::any_of(overlaps.begin(), overlaps.end(), [&](const Overlap& one) {
      return one.owner == grains::wall_code(step.wall);
    });
    if (!lasts) {
      world.pushes.forget(world.state, id, grains::wall_code(step.wall));
      world.awake.insert(id);
    }
  }
}

}  // namespace

bool push_along(World& world, const WallStep& step) {
  Train train(world, step);
  if (!train.gather()) {
    return false;
  }
  leave(world, step);
  world.shift_together(train.ids(), step.direction);
  for (const std::size_t place : step.enters) {
    world.occupancy.add(place, grains::wall_code(step.wall));
  }
  wake_behind(world, step);
  world.changed = true;
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
  forget_behind(world, step);
  wake_behind(world, step);
  world.changed = true;
  return true;
}

bool can_take(World& world, const WallStep& step) {
  if (!world.state.walls[step.wall].lets_overlap()) {
    return Train(world, step).gather();
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
