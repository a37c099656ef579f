#pragma once
// The sites of particles and walls.

#include <algorithm>
#include <vector>

#include "clca/grains/occupancy.hpp"
#include "clca/grains/state.hpp"
#include "lattice/internal/require.hpp"

namespace clca::measure {

/// Calls visit(site) for every site of every present particle, wrapped into the box. A shared site
/// comes twice.
template <typename Visit>
void for_each_site(const grains::State& state, const Visit& visit) {
  for (const grains::Particle& particle : state.particles) {
    if (!particle.present) {
      continue;
    }
    for (const lattice::Axial part : state.shape(particle).sites()) {
      lattice::Site site = particle.site() + part;
      site.column = state.lattice.wrapped(site.column);
      visit(site);
    }
  }
}

/// Largest distance of a site of the shape from its centre of mass, lattice spacings.
inline double reach(const lattice::Shape& shape) {
  double result = 0;
  for (const lattice::Axial site : shape.sites()) {
    result = std::max(result, (lattice::position(site) - shape.centroid()).norm());
  }
  return result;
}

/// Throws std::invalid_argument if the occupancy is that of another box.
inline void check_occupancy(const grains::State& state, const grains::Occupancy& occupancy) {
  require(occupancy.index_count() == state.lattice.index_count(),
          "the occupancy is that of another box");
}

/// Sites of the present walls, sorted, without duplicates.
inline std::vector<lattice::Site> wall_sites(const grains::State& state) {
  std::vector<lattice::Site> sites;
  for (const grains::Wall& wall : state.walls) {
    if (wall.present) {
      const std::vector<lattice::Site> covered = grains::sites_now(state.lattice, wall);
      sites.insert(sites.end(), covered.begin(), covered.end());
    }
  }
  std::ranges::sort(sites);
  sites.erase(std::unique(sites.begin(), sites.end()), sites.end());
  return sites;
}

}  // namespace clca::measure
