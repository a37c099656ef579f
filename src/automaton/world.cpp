#include "automaton/world.hpp"

#include <algorithm>
#include <utility>

namespace clca::automaton {

namespace {

constexpr std::size_t kNeighbours = 8;  // more seldom share sites with one particle

}  // namespace

World::World(grains::State initial, const Rules& given_rules)
    : state(std::move(initial)),
      rules(given_rules),
      occupancy(state),
      footprints(state, candidate_directions(rules)),
      pushes(state),
      separation(state) {
  state.origins.resize(state.particles.size());
  welcome_from(0);
}

void World::welcome_from(std::size_t first) {
  awake.resize(state.particles.size());
  pushes.grow(state.particles.size());
  for (std::size_t id = first; id < state.particles.size(); ++id) {
    awake.insert(static_cast<std::uint32_t>(id));
    changed = true;
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
  result.reserve(kNeighbours);
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

void World::shift(std::uint32_t id, lattice::Direction direction) {
  grains::Particle& particle = state.particles[id];
  const auto owner = static_cast<grains::Owner>(id);
  const bool engaged = pushes.engaged(id);
  const std::vector<Overlap> before = engaged ? overlaps(id, particle) : std::vector<Overlap>();
  const grains::Footprint& footprint = footprints.of(particle);
  for_each_place(particle, footprint.trail[index_of(direction)], [&](std::size_t place) {
    if (occupancy.remove(place, owner)) {
      wake_upstream(place);
    }
  });
  for_each_place(particle, footprint.lead[index_of(direction)],
                 [&](std::size_t place) { occupancy.add(place, owner); });
  particle = moved(particle, direction);
  particle.previous = static_cast<grains::Move>(direction);
  awake.insert(id);
  forget_ended(id, before);
}

void World::forget_ended(std::uint32_t id, const std::vector<Overlap>& before) {
  if (before.empty()) {
    return;
  }
  const std::vector<Overlap> after = overlaps(id, state.particles[id]);
  for (const Overlap& one : before) {
    const bool lasts = std::any_of(after.begin(), after.end(),
                                   [&](const Overlap& other) { return other.owner == one.owner; });
    if (lasts) {
      continue;
    }
    pushes.forget(state, id, one.owner);
    if (grains::is_particle(one.owner)) {
      awake.insert(static_cast<std::uint32_t>(one.owner));
    }
  }
}

void World::shift_together(std::span<const std::uint32_t> ids, lattice::Direction direction) {
  const std::size_t d = index_of(direction);
  std::vector<std::size_t> left;
  for (const std::uint32_t id : ids) {
    const grains::Particle& particle = state.particles[id];
    for_each_place(particle, footprints.of(particle).trail[d], [&](std::size_t place) {
      occupancy.remove(place, static_cast<grains::Owner>(id));
      left.push_back(place);
    });
  }
  for (const std::uint32_t id : ids) {
    grains::Particle& particle = state.particles[id];
    for_each_place(particle, footprints.of(particle).lead[d], [&](std::size_t place) {
      occupancy.add(place, static_cast<grains::Owner>(id));
    });
    particle = moved(particle, direction);
    awake.insert(id);
  }
  carried.insert(carried.end(), ids.begin(), ids.end());
  for (const std::size_t place : left) {
    if (!occupancy.taken(place)) {
      wake_upstream(place);
    }
  }
}

void World::take_away(std::uint32_t id) {
  changed = true;
  grains::Particle& particle = state.particles[id];
  for (const Overlap& one : overlaps(id, particle)) {
    pushes.forget(state, id, one.owner);
    if (grains::is_particle(one.owner)) {
      awake.insert(static_cast<std::uint32_t>(one.owner));
    }
  }
  for_each_place(particle, [&](std::size_t place) {
    if (occupancy.remove(place, static_cast<grains::Owner>(id))) {
      wake_upstream(place);
    }
  });
  particle.present = false;
  particle.previous = grains::kRest;
}

void World::wake_upstream(std::size_t place) {
  const lattice::Site site = state.lattice.site(place);
  for (const lattice::Direction direction : candidate_directions(rules)) {
    const lattice::Site from = site + lattice::unit(opposite(direction));
    if (!state.lattice.contains(from)) {
      continue;
    }
    const grains::Owner owner = occupancy.owner(state.lattice.index(from));
    if (grains::is_particle(owner)) {
      awake.insert(static_cast<std::uint32_t>(owner));
    }
  }
}

}  // namespace clca::automaton
