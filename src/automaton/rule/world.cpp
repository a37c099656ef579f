#include "automaton/rule/world.hpp"

#include <algorithm>
#include <utility>

namespace clca::automaton {

namespace {

constexpr std::size_t kUsualOverlaps = 8;  // of one particle, at most

bool contains(const std::vector<Overlap>& overlaps, grains::Owner owner) {
  return std::any_of(overlaps.begin(), overlaps.end(),
                     [owner](const Overlap& overlap) { return overlap.owner == owner; });
}

}  // namespace

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

bool World::is_free(const grains::Particle& particle, lattice::Direction direction) const {
  bool free = true;
  box.for_each_index(particle, box.footprints.of(particle).lead[index_of(direction)],
                     [&](std::size_t index) { free = free && !occupancy.taken(index); });
  return free;
}

std::vector<Overlap> World::overlaps(std::uint32_t id, const grains::Particle& at) const {
  std::vector<Overlap> result;
  result.reserve(kUsualOverlaps);
  const auto count = [&](grains::Owner owner) {
    if (owner == grains::kFree || owner == grains::as_owner(id)) {
      return;
    }
    const auto found = std::find_if(result.begin(), result.end(), [owner](const Overlap& overlap) {
      return overlap.owner == owner;
    });
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
  grains::Particle& particle = state.particles[id];
  const auto owner = grains::as_owner(id);
  const std::vector<Overlap> before =
      pushes.overlapping(id) ? overlaps(id, particle) : std::vector<Overlap>();
  const grains::Footprint& footprint = box.footprints.of(particle);
  box.for_each_index(particle, footprint.trail[index_of(direction)], [&](std::size_t index) {
    if (occupancy.remove(index, owner)) {
      changes.vacated.push_back(index);
    }
  });
  box.for_each_index(particle, footprint.lead[index_of(direction)],
                     [&](std::size_t index) { occupancy.add(index, owner); });
  particle = moved(particle, direction);
  particle.previous = static_cast<grains::Move>(direction);
  changes.particles.push_back(id);
  forget_ended_pushes(id, before);
}

void World::forget_ended_pushes(std::uint32_t id, const std::vector<Overlap>& before) {
  if (before.empty()) {
    return;
  }
  const std::vector<Overlap> after = overlaps(id, state.particles[id]);
  for (const Overlap& overlap : before) {
    if (!contains(after, overlap.owner)) {
      forget_push(id, overlap.owner);
    }
  }
}

void World::forget_push(std::uint32_t id, grains::Owner other) {
  pushes.forget(state, id, other);
  if (grains::is_particle(other)) {
    changes.particles.push_back(grains::particle_id(other));
  }
}

void World::move_together(std::span<const std::uint32_t> ids, lattice::Direction direction) {
  const std::size_t d = index_of(direction);
  for (const std::uint32_t id : ids) {
    const grains::Particle& particle = state.particles[id];
    box.for_each_index(particle, box.footprints.of(particle).trail[d], [&](std::size_t index) {
      occupancy.remove(index, grains::as_owner(id));
      changes.vacated.push_back(index);
    });
  }
  for (const std::uint32_t id : ids) {
    grains::Particle& particle = state.particles[id];
    box.for_each_index(particle, box.footprints.of(particle).lead[d],
                       [&](std::size_t index) { occupancy.add(index, grains::as_owner(id)); });
    particle = moved(particle, direction);
  }
  changes.particles.insert(changes.particles.end(), ids.begin(), ids.end());
  carried.insert(carried.end(), ids.begin(), ids.end());
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
