#pragma once
// The sites of all particles.

#include <algorithm>

#include "clca/grains/state.hpp"

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

}  // namespace clca::measure
