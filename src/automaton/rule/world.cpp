#include "automaton/rule/world.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace clca::automaton {

namespace {

constexpr std::size_t kUsualOverlaps = 8;  // of one particle, at most

auto lower_bound(const std::vector<grains::Push>& pushes, std::uint32_t pushed,
                 grains::Owner pusher) {
  return std::ranges::lower_bound(pushes, std::pair(pushed, pusher), {},
                                  [](const grains::Push& push) { return push.key(); });
}

}  // namespace

PushList::PushList(const grains::State& state) : parts_(state.particles.size(), 0) {
  for (const grains::Push& push : state.pushes) {
    count(push, 1);
  }
}

std::vector<std::uint32_t> PushList::overlapping_particles(const grains::State& state) {
  std::vector<std::uint32_t> ids;
  for (const grains::Push& push : state.pushes) {
    ids.push_back(push.pushed);
    if (grains::is_particle(push.pusher)) {
      ids.push_back(static_cast<std::uint32_t>(push.pusher));
    }
  }
  std::ranges::sort(ids);
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  return ids;
}

std::span<const grains::Push> PushList::onto(const grains::State& state, std::uint32_t id) {
  constexpr grains::Owner kLowest = std::numeric_limits<grains::Owner>::min();
  const auto first = lower_bound(state.pushes, id, kLowest);
  const auto last = std::find_if(first, state.pushes.end(),
                                 [id](const grains::Push& push) { return push.pushed != id; });
  return {first, last};
}

void PushList::record(grains::State& state, const grains::Push& push) {
  const auto position =
      state.pushes.begin() +
      (lower_bound(state.pushes, push.pushed, push.pusher) - state.pushes.cbegin());
  if (position != state.pushes.end() && position->key() == push.key()) {
    *position = push;
    return;
  }
  state.pushes.insert(position, push);
  count(push, 1);
}

void PushList::forget(grains::State& state, std::uint32_t id, grains::Owner other) {
  if (!erase(state, id, other) && grains::is_particle(other)) {
    erase(state, grains::particle_id(other), grains::as_owner(id));
  }
}

bool PushList::erase(grains::State& state, std::uint32_t pushed, grains::Owner pusher) {
  const grains::Push* push = find_push(state, pushed, pusher);
  if (push == nullptr) {
    return false;
  }
  count(*push, -1);
  state.pushes.erase(state.pushes.begin() + (push - state.pushes.data()));
  return true;
}

void PushList::count(const grains::Push& push, int change) {
  parts_[push.pushed] += static_cast<std::uint32_t>(change);
  if (grains::is_particle(push.pusher)) {
    parts_[static_cast<std::size_t>(push.pusher)] += static_cast<std::uint32_t>(change);
  }
}

bool shares(const std::vector<Overlap>& overlaps, grains::Owner owner) {
  return std::ranges::find(overlaps, owner, &Overlap::owner) != overlaps.end();
}

World::World(grains::Box& around, const Rules& given_rules)
    : box(around),
      state(around.state),
      occupancy(around.occupancy),
      rules(given_rules),
      pushes(state) {
  state.origins.resize(state.particles.size());
  include_new(0);
}

void World::include_new(std::size_t first) {
  pushes.resize(state.particles.size());
  for (std::size_t id = first; id < state.particles.size(); ++id) {
    changes.particles.push_back(static_cast<std::uint32_t>(id));
    changes.by_others = true;
  }
}

std::vector<Overlap> World::overlaps(std::uint32_t id, const grains::Particle& at) const {
  std::vector<Overlap> result;
  result.reserve(kUsualOverlaps);
  const auto count = [&](grains::Owner owner) {
    if (owner == grains::kFree || owner == grains::as_owner(id)) {
      return;
    }
    const auto found = std::ranges::find(result, owner, &Overlap::owner);
    if (found == result.end()) {
      result.push_back({owner, 1});
    } else {
      ++found->sites;
    }
  };
  box.for_each_index(at, [&](std::size_t index) {
    count(occupancy.owner(index));
    count(occupancy.second_owner(index));
  });
  return result;
}

void World::move(std::uint32_t id, lattice::Direction direction) {
  const std::vector<Overlap> before =
      pushes.overlapping(id) ? overlaps(id, state.particles[id]) : std::vector<Overlap>();
  leave(id, direction);
  enter(id, direction);
  state.particles[id].previous = static_cast<grains::Move>(direction);
  changes.particles.push_back(id);
  if (!before.empty()) {
    const std::vector<Overlap> after = overlaps(id, state.particles[id]);
    for (const Overlap& overlap : before) {
      if (!shares(after, overlap.owner)) {
        forget_push(id, overlap.owner);
      }
    }
  }
}

void World::move_together(std::span<const std::uint32_t> ids, lattice::Direction direction) {
  for (const std::uint32_t id : ids) {
    leave(id, direction);
  }
  for (const std::uint32_t id : ids) {
    enter(id, direction);
  }
  changes.particles.insert(changes.particles.end(), ids.begin(), ids.end());
  carried.insert(carried.end(), ids.begin(), ids.end());
}

// The two halves of a move.
void World::leave(std::uint32_t id, lattice::Direction direction) {
  box.for_each_left(state.particles[id], direction, [&](std::size_t index) {
    if (occupancy.remove(index, grains::as_owner(id))) {
      changes.vacated.push_back(index);
    }
  });
}

void World::enter(std::uint32_t id, lattice::Direction direction) {
  grains::Particle& particle = state.particles[id];
  box.for_each_entered(particle, direction,
                       [&](std::size_t index) { occupancy.add(index, grains::as_owner(id)); });
  particle = moved(particle, direction);
}

void World::forget_push(std::uint32_t id, grains::Owner other) {
  pushes.forget(state, id, other);
  if (grains::is_particle(other)) {
    changes.particles.push_back(grains::particle_id(other));
  }
}

void World::let_go(std::uint32_t id) {
  const grains::Particle& particle = state.particles[id];
  for (const Overlap& overlap : overlaps(id, particle)) {
    forget_push(id, overlap.owner);
  }
  box.for_each_index(particle, [&](std::size_t index) { changes.vacated.push_back(index); });
  changes.by_others = true;
}

void World::reload() {
  const std::vector<grains::Push> all = state.pushes;
  for (const grains::Push& push : all) {
    if (grains::is_wall(push.pusher) && !state.walls[grains::wall_number(push.pusher)].present) {
      pushes.forget(state, push.pushed, push.pusher);
    }
  }
  include_new(0);
}

}  // namespace clca::automaton
