#include <algorithm>
#include <numeric>

#include "clca/random/draw.hpp"
#include "grains/internal/filling.hpp"

namespace clca::grains {

std::vector<std::uint16_t> kinds_of(const State& state, std::size_t species) {
  std::vector<std::uint16_t> kinds;
  for (std::size_t kind = 0; kind < state.kinds.size(); ++kind) {
    if (state.kinds[kind].species == species) {
      kinds.push_back(static_cast<std::uint16_t>(kind));
    }
  }
  return kinds;
}

bool fits(const Box& box, const Particle& particle) {
  const lattice::Lattice& lattice = box.state.lattice;
  const auto& parts = box.state.shape(particle).sites();
  return std::ranges::all_of(parts, [&](lattice::Axial part) {
    const lattice::Site site = particle.site() + part;
    return lattice.contains(site) && !box.occupancy.taken(lattice.index(site));
  });
}

bool lies_inside(const State& state, const Particle& particle, const lattice::Rectangle& region) {
  const auto& parts = state.shape(particle).sites();
  return std::ranges::all_of(parts, [&](lattice::Axial part) {
    const lattice::Site site = particle.site() + part;
    return region.contains(
        lattice::position(lattice::Site{state.lattice.wrapped(site.column), site.row}));
  });
}

void insert(Box& box, const Particle& particle) {
  const auto id = as_owner(box.state.particles.size());
  box.for_each_index(particle, [&](std::size_t index) { box.occupancy.take(index, id); });
  box.state.particles.push_back(particle);
  box.state.origins.push_back(particle.site());
}

std::size_t draw_species(const State& state, std::span<const std::size_t> weights) {
  const auto id = static_cast<std::uint32_t>(state.particles.size());
  const std::uint64_t all = std::accumulate(weights.begin(), weights.end(), std::uint64_t{0});
  std::uint64_t drawn =
      random::below(random::draw(state.seed, 0, id, random::Purpose::deposit_species), all);
  std::size_t species = 0;
  while (drawn >= weights[species]) {
    drawn -= weights[species++];
  }
  return species;
}

void renumber(Box& box, std::size_t first) {
  std::vector<Particle>& particles = box.state.particles;
  std::sort(particles.begin() + static_cast<std::ptrdiff_t>(first), particles.end(),
            [](const Particle& a, const Particle& b) { return a.site() < b.site(); });
  for (std::size_t id = first; id < particles.size(); ++id) {
    box.state.origins[id] = particles[id].site();
    box.for_each_index(particles[id],
                       [&](std::size_t index) { box.occupancy.take(index, as_owner(id)); });
  }
}

std::size_t outlet_around(const State& state, const Particle& particle) {
  const auto outlet = std::ranges::find_if(state.outlets, [&](const Outlet& candidate) {
    return lies_inside(state, particle, candidate.region);
  });
  return static_cast<std::size_t>(outlet - state.outlets.begin());
}

bool count_at_outlet(State& state, std::uint32_t id) {
  const Particle& particle = state.particles[id];
  if (!particle.present) {
    return false;
  }
  const std::size_t outlet = outlet_around(state, particle);
  if (outlet == state.outlets.size()) {
    return false;
  }
  ++state.outlets[outlet].particles;
  state.outlets[outlet].sites += state.shape(particle).size();
  return true;
}

}  // namespace clca::grains
