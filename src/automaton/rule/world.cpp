#include "automaton/rule/world.hpp"

#include <algorithm>
#include <utility>

namespace clca::automaton {

namespace {

constexpr std::size_t kUsualOverlaps = 8;  // of one particle, at most

bool contains(const std::vector<Overlap>& overlaps, grains::Owner owner) {
  return std::any_of(overlaps.begin(), overlaps.end(),
                     [owner](const Overlap& one) { return one.owner == owner; });
}

}  // namespace

World::World(grains::State initial, const Rules& given_rules)
    : state(std::move(initial)),
      rules(given_rules),
      occupancy(state),
      footprints(state, candidate_directions(rules)),
      pushes(state),
      separation(state) {
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
  for_each_place(particle, footprints.of(particle).lead[index_of(direction)],
                 [&](std::size_t place) { free = free && !occupancy.taken(place); });
  return free;
}

std::vector<Overlap> World::overlaps(std::uint32_t id, const grains::Particle& at) const {
  std::vector<Overlap> result;
  result.reserve(kUsualOverlaps);
  const auto count = [&](grains::Owner owner) {
    if (owner == grains::kFree || owner == static_cast<grains::Owner>(id)) {
      return;
    }
    const auto found = std::find_if(result.begin(), result.end(),
                                    [owner](const Overlap& one) { return one.owner == owner; });
    if (found == result.end()) {
      result.push_back({owner, 1});
    } else {
      ++found->sites;
    }
  };
  for_each_place(at, [&](std::size_t place) {
    count(occupancy.owner(place));
    count(occupancy.second_owner(place));
  });
  return result;
}

void World::move(std::uint32_t id, lattice::Direction direction) {
  grains::Particle& particle = state.particles[id];
  const auto owner = static_cast<grains::Owner>(id);
  const std::vector<Overlap> before =
      pushes.overlapping(id) ? overlaps(id, particle) : std::vector<Overlap>();
  const grains::Footprint& footprint = footprints.of(particle);
  for_each_place(particle, footprint.trail[index_of(direction)], [&](std::size_t place) {
    if (occupancy.remove(place, owner)) {
      changes.vacated.push_back(place);
    }
  });
  for_each_place(particle, footprint.lead[index_of(direction)],
                 [&](std::size_t place) { occupancy.add(place, owner); });
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
  for (const Overlap& one : before) {
    if (!contains(after, one.owner)) {
      forget_push(id, one.owner);
    }
  }
}

void World::forget_push(std::uint32_t id, grains::Owner other) {
  pushes.forget(state, id, other);
  if (grains::is_particle(other)) {
    changes.particles.push_back(static_cast<std::uint32_t>(other));
  }
}

void World::move_together(std::span<const std::uint32_t> ids, lattice::Direction direction) {
  const std::size_t d = index_of(direction);
  for (const std::uint32_t id : ids) {
    const grains::Particle& particle = state.particles[id];
    for_each_place(particle, footprints.of(particle).trail[d], [&](std::size_t place) {
      occupancy.remove(place, static_cast<grains::Owner>(id));
      changes.vacated.push_back(place);
    });
  }
  for (const std::uint32_t id : ids) {
    grains::Particle& particle = state.particles[id];
    for_each_place(particle, footprints.of(particle).lead[d], [&](std::size_t place) {
      occupancy.add(place, static_cast<grains::Owner>(id));
    });
    particle = moved(particle, direction);
  }
  changes.particles.insert(changes.particles.end(), ids.begin(), ids.end());
  carried.insert(carried.end(), ids.begin(), ids.end());
}

void World::remove(std::uint32_t id) {
  grains::Particle& particle = state.particles[id];
  for (const Overlap& one : overlaps(id, particle)) {
    forget_push(id, one.owner);
  }
  for_each_place(particle, [&](std::size_t place) {
    if (occupancy.remove(place, static_cast<grains::Owner>(id))) {
      changes.vacated.push_back(place);
    }
  });
  particle.present = false;
  particle.previous = grains::kRest;
  changes.by_others = true;
}

}  // namespace clca::automaton
