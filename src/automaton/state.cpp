#include "clca/automaton/state.hpp"

#include <algorithm>

#include "random/word_hash.hpp"

namespace clca::automaton {

namespace {

using random::WordHash;

void add_site(WordHash& words, lattice::Site site) {
  words.add((static_cast<std::uint64_t>(static_cast<std::uint32_t>(site.column)) << 32U) |
            static_cast<std::uint32_t>(site.row));
}

void add_travel(WordHash& words, const Travel& travel) {
  words.add((static_cast<std::uint64_t>(static_cast<std::uint32_t>(travel.offset)) << 32U) |
            (static_cast<std::uint64_t>(travel.phase) << 1U) | (travel.active ? 1U : 0U));
  words.add(travel.clock);
  words.add(travel.waited);
  words.add(travel.cycles);
  words.add(travel.stalls);
  words.add(travel.stalled_since ? *travel.stalled_since + 1 : 0);
}

}  // namespace

Eigen::Vector2d centre(const State& state, const Particle& particle) {
  return lattice::position(particle.site()) + state.shape(particle).centroid();
}

lattice::Axial Wall::shift() const {
  if (!motion) {
    return {};
  }
  const lattice::Axial one = unit(motion->direction);
  return {travel.offset * one.x, travel.offset * one.q};
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
  return std::any_of(state.walls.begin(), state.walls.end(),
                     [](const Wall& wall) { return wall.lets_overlap(); });
}

std::size_t present_count(const State& state) {
  return static_cast<std::size_t>(std::count_if(state.particles.begin(), state.particles.end(),
                                                [](const Particle& p) { return p.present; }));
}

std::uint64_t hash(const State& state) {
  WordHash words;
  words.add(state.seed);
  words.add(state.step);
  words.add(state.particles.size());
  for (const Particle& particle : state.particles) {
    add_site(words, particle.site());
    words.add((std::uint64_t{particle.kind} << 16U) | (std::uint64_t{particle.previous} << 8U) |
              (particle.present ? 1U : 0U));
  }
  for (const Wall& wall : state.walls) {
    words.add(wall.present ? 1 : 0);
    if (wall.motion) {
      add_travel(words, wall.travel);
    }
  }
  for (const Source& source : state.sources) {
    words.add(source.credit);
    words.add((source.emitted << 1U) | (source.open ? 1U : 0U));
  }
  for (const Outlet& outlet : state.outlets) {
    words.add(outlet.particles);
    words.add(outlet.sites);
  }
  for (const Push& push : state.pushes) {
    words.add((std::uint64_t{push.pushed} << 32U) | static_cast<std::uint32_t>(push.pusher));
    words.add((std::uint64_t{push.source} << 8U) | static_cast<std::uint64_t>(push.direction));
  }
  return words.value();
}

}  // namespace clca::automaton
