#include "grains/internal/outlet.hpp"

#include <algorithm>

#include "grains/placement.hpp"

namespace clca::grains {

std::size_t outlet_around(const State& state, const Particle& particle) {
  const auto outlet = std::find_if(
      state.outlets.begin(), state.outlets.end(),
      [&](const Outlet& candidate) { return lies_inside(state, particle, candidate.region); });
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
