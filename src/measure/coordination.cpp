#include "clca/measure/coordination.hpp"

#include <algorithm>

#include "measure/check_occupancy.hpp"

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
      if (std::find(touched.begin(), touched.end(), owner) == touched.end()) {
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

}  // namespace clca::measure
