#include "automaton/rule/overlap_change.hpp"

namespace clca::automaton {

std::vector<OverlapChange> overlap_changes(const World& world, std::uint32_t id,
                                           lattice::Direction direction) {
  const grains::State& state = world.state;
  const grains::Particle& here = state.particles[id];
  const std::vector<Overlap> before = world.overlaps(id, here);
  const std::vector<Overlap> after = world.overlaps(id, moved(here, direction));
  std::vector<OverlapChange> result;
  result.reserve(before.size() + after.size());
  for (const Overlap& overlap : before) {
    result.push_back({.owner = overlap.owner, .sites_before = overlap.sites});
  }
  for (const Overlap& overlap : after) {
    auto change = std::ranges::find(result, overlap.owner, &OverlapChange::owner);
    if (change == result.end()) {
      change = result.insert(result.end(), {.owner = overlap.owner});
    }
    change->sites_after = overlap.sites;
  }
  return result;
}

const OverlapChange* find(const std::vector<OverlapChange>& changes, grains::Owner owner) {
  const auto found = std::ranges::find(changes, owner, &OverlapChange::owner);
  return found == changes.end() ? nullptr : &*found;
}

int shared_sites(const World& world, std::uint32_t id) {
  int sum = 0;
  world.box.for_each_index(world.state.particles[id], [&](std::size_t index) {
    // A wall is the first owner of a site, so this is one only if both are particles.
    const bool two = world.occupancy.second_owner(index) != grains::kFree;
    sum += two && grains::is_particle(world.occupancy.owner(index)) ? 1 : 0;
  });
  return sum;
}

bool can_leave(const World& world, const grains::Particle& particle, grains::Owner owner,
               std::span<const lattice::Direction> directions) {
  const lattice::Lattice& lattice = world.state.lattice;
  return std::ranges::any_of(directions, [&](lattice::Direction direction) {
    const grains::Particle target = moved(particle, direction);
    const std::size_t index = lattice.index(target.site());
    const int column = lattice.wrapped(target.column);
    const std::vector<lattice::Offset>& body = world.box.footprints.of(target).body;
    return std::ranges::none_of(body, [&](lattice::Offset offset) {
      return world.occupancy.has(lattice.at(index, column, offset), owner);
    });
  });
}

bool is_too_deep(const World& world, const grains::Particle& there, const OverlapChange& change) {
  return grains::is_particle(change.owner) && change.sites_before > 0 && change.sites_after > 0 &&
         !can_leave(world, there, change.owner, lattice::kDirections);
}

}  // namespace clca::automaton
