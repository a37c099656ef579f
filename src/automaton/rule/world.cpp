#include "automaton/rule/world.hpp"

#include <algorithm>

namespace clca::automaton {

bool has_owner(const std::vector<Overlap>& overlaps, grains::Owner owner) {
  return std::ranges::find(overlaps, owner, &Overlap::owner) != overlaps.end();
}

World::World(grains::Box& around, const Rules& given_rules)
    : box(around), state(around.state), occupancy(around.occupancy), rules(given_rules) {
  state.origins.resize(state.particles.size());
  include_new(0);
  for (const grains::Push& push : state.pushes) {
    count_push(push, 1);
  }
}

void World::include_new(std::size_t first) {
  push_counts_.resize(state.particles.size(), 0);
  for (std::size_t id = first; id < state.particles.size(); ++id) {
    changes.changed_particles.push_back(static_cast<std::uint32_t>(id));
    changes.by_others = true;
  }
}

std::vector<Overlap> World::overlaps_at(std::uint32_t id, const grains::Particle& at) const {
  constexpr std::size_t kUsual = 8;  // more are rare
  std::vector<Overlap> result;
  result.reserve(kUsual);
  const auto count = [&](grains::Owner owner) {
    if (owner == grains::kFree || owner == grains::as_owner(id)) {
      return;
    }
    const auto found = std::ranges::find(result, owner, &Overlap::owner);
    if (found == result.end()) {
      result.push_back({owner, 1});
    } else {
      ++found->shared_sites;
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
      is_overlapping(id) ? overlaps_at(id, state.particles[id]) : std::vector<Overlap>();
  change_sites({&id, 1}, direction);
  state.particles[id].previous = static_cast<grains::Move>(direction);
  if (!before.empty()) {
    const std::vector<Overlap> after = overlaps_at(id, state.particles[id]);
    for (const Overlap& overlap : before) {
      if (!has_owner(after, overlap.owner)) {
        forget_push(id, overlap.owner);
      }
    }
  }
}

void World::move_together(std::span<const std::uint32_t> ids, lattice::Direction direction) {
  change_sites(ids, direction);
  moved_by_walls.insert(moved_by_walls.end(), ids.begin(), ids.end());
}

void World::change_sites(std::span<const std::uint32_t> ids, lattice::Direction direction) {
  for (const std::uint32_t id : ids) {
    box.for_each_vacated(state.particles[id], direction, [&](std::size_t index) {
      if (occupancy.remove_owner(index, grains::as_owner(id))) {
        changes.vacated_sites.push_back(index);
      }
    });
  }
  for (const std::uint32_t id : ids) {
    grains::Particle& particle = state.particles[id];
    box.for_each_entered(particle, direction, [&](std::size_t index) {
      occupancy.add_owner(index, grains::as_owner(id));
    });
    particle = after_step(particle, direction);
  }
  changes.changed_particles.insert(changes.changed_particles.end(), ids.begin(), ids.end());
}

std::vector<std::uint32_t> World::overlapping_particles() const {
  std::vector<std::uint32_t> ids;
  for (const grains::Push& push : state.pushes) {
    ids.push_back(push.pushed);
    if (grains::is_particle(push.pusher)) {
      ids.push_back(grains::particle_id(push.pusher));
    }
  }
  std::ranges::sort(ids);
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  return ids;
}

std::span<const grains::Push> World::pushes_onto(std::uint32_t id) const {
  return {std::ranges::lower_bound(state.pushes, id, {}, &grains::Push::pushed),
          std::ranges::upper_bound(state.pushes, id, {}, &grains::Push::pushed)};
}

void World::record_push(const grains::Push& push) {
  const auto at = std::ranges::lower_bound(state.pushes, push.key(), {}, &grains::Push::key);
  if (at != state.pushes.end() && at->key() == push.key()) {
    *at = push;
  } else {
    state.pushes.insert(at, push);
    count_push(push, 1);
  }
}

void World::forget_push(std::uint32_t id, grains::Owner other) {
  const grains::Push* push = find_push(state, id, other);
  if (grains::is_particle(other)) {
    changes.changed_particles.push_back(grains::particle_id(other));
    push =
        push != nullptr ? push : find_push(state, grains::particle_id(other), grains::as_owner(id));
  }
  if (push != nullptr) {
    count_push(*push, -1);
    state.pushes.erase(state.pushes.begin() + (push - state.pushes.data()));
  }
}

void World::count_push(const grains::Push& push, int change) {
  push_counts_[push.pushed] += static_cast<std::uint32_t>(change);
  if (grains::is_particle(push.pusher)) {
    push_counts_[grains::particle_id(push.pusher)] += static_cast<std::uint32_t>(change);
  }
}

void World::prepare_removal(std::uint32_t id) {
  const grains::Particle& particle = state.particles[id];
  for (const Overlap& overlap : overlaps_at(id, particle)) {
    forget_push(id, overlap.owner);
  }
  box.for_each_index(particle, [&](std::size_t index) { changes.vacated_sites.push_back(index); });
  changes.by_others = true;
}

void World::reload() {
  const std::vector<grains::Push> all = state.pushes;
  for (const grains::Push& push : all) {
    if (grains::is_obstacle(push.pusher) &&
        !state.walls[grains::wall_number(push.pusher)].present) {
      forget_push(push.pushed, push.pusher);
    }
  }
  include_new(0);
}

}  // namespace clca::automaton
