#include "clca/measure/coordination.hpp"

#include <algorithm>

#include "clca/baxter/baxter_model.hpp"
#include "measure/places.hpp"

namespace clca::measure {

std::vector<int> coordination(const grains::State& state, const grains::Occupancy& occupancy) {
  check_occupancy(state, occupancy);
  std::vector<int> result(state.particles.size(), 0);
  std::vector<grains::Owner> touched;
  for (std::size_t id = 0; id < result.size(); ++id) {
    const grains::Particle& particle = state.particles[id];
    if (!particle.present) {
      continue;
    }
    touched = {grains::kFree, grains::as_owner(id)};
    const auto add = [&](grains::Owner owner) {
      if (std::ranges::find(touched, owner) == touched.end()) {
        touched.push_back(owner);
      }
    };
    for (const lattice::Axial part : state.shape(particle).sites()) {
      const lattice::Site site = particle.site() + part;
      add(occupancy.owner(state.lattice.index(site)));
      add(occupancy.second_owner(state.lattice.index(site)));
      for (const lattice::Direction direction : lattice::kDirections) {
        const std::size_t beside = state.lattice.index(site + unit(direction));
        add(occupancy.owner(beside));
        add(occupancy.second_owner(beside));
      }
    }
    result[id] = static_cast<int>(touched.size()) - 2;
  }
  return result;
}

std::optional<double> axis_order(const grains::State& state) {
  using lattice::Direction;
  const grains::Occupancy occupancy(state);
  double pairs = 0;
  double equal = 0;
  for (const grains::Particle& grain : state.particles) {
    if (!grain.present) {
      continue;
    }
    for (const Direction direction : {Direction::up, Direction::up_right, Direction::down_right}) {
      const grains::Owner owner =
          occupancy.owner(state.lattice.index(grain.site() + unit(direction)));
      if (grains::is_particle(owner)) {
        const auto& neighbour = state.particles[grains::particle_id(owner)];
        pairs += 1;
        equal += baxter::axis_of(grain) == baxter::axis_of(neighbour) ? 1 : 0;
      }
    }
  }
  return pairs > 0 ? std::optional(equal / pairs) : std::nullopt;
}

}  // namespace clca::measure
