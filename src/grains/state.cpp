#include "clca/grains/state.hpp"

#include <algorithm>

#include "clca/reflection/hash.hpp"

namespace clca::grains {

Eigen::Vector2d centre(const State& state, const Particle& particle) {
  return lattice::position(particle.site()) + state.shape(particle).centroid();
}

Eigen::Vector2d centre_in_box(const State& state, const Particle& particle) {
  const lattice::Site site = {state.lattice.wrapped(particle.column), particle.row};
  return state.lattice.in_box(lattice::position(site) + state.shape(particle).centroid());
}

lattice::Axial Wall::shift() const {
  if (!motion) {
    return {};
  }
  const lattice::Axial unit_vector = unit(motion->direction);
  return {travel.offset * unit_vector.x, travel.offset * unit_vector.q};
}

std::vector<lattice::Site> sites_now(const lattice::Lattice& lattice, const Wall& wall) {
  const lattice::Axial shift = wall.shift();
  std::vector<lattice::Site> sites;
  sites.reserve(wall.sites.size());
  for (const lattice::Site home : wall.sites) {
    const lattice::Site site = home + shift;
    if (lattice.contains(site)) {
      sites.push_back({lattice.wrapped(site.column), site.row});
    }
  }
  return sites;
}

bool may_overlap(const State& state) {
  return std::ranges::any_of(state.walls, [](const Wall& wall) { return wall.lets_overlap(); });
}

std::size_t present_count(const State& state) {
  return static_cast<std::size_t>(
      std::ranges::count_if(state.particles, [](const Particle& p) { return p.present; }));
}

const Push* find_push(const State& state, std::uint32_t pushed, Owner pusher) {
  const std::pair key(pushed, pusher);
  const auto found =
      std::ranges::lower_bound(state.pushes, key, {}, [](const Push& push) { return push.key(); });
  return found != state.pushes.end() && found->key() == key ? &*found : nullptr;
}

std::uint64_t hash(const State& state) {
  return reflection::hash(state);
}

}  // namespace clca::grains
