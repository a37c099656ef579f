#include "grains/internal/outlet.hpp"

#include <algorithm>

#include "grains/placement.hpp"

namespace clca::grains {

bool count_at_outlet(State& state, std::uint32_t id) {
  const Particle& particle = state.particles[id];
  if (!particle.present) {
    return false;
  }
  const auto outlet =
      std::find_if(state.outlets.begin(), state.outlets.end(),
                   [&](const Outlet& one) { return lies_inside(state, particle, one.region); });
  if (outlet == state.outlets.end()) {
    return false;
  }
  ++outlet->particles;
  outlet->sites += state.shape(particle).size();
  return true;
}

}  // namespace clca::grains
