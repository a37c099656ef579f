#pragma once
// The shade of a particle by each rule: an index into the palette of its colouring.

#include <algorithm>

#include "clca/render/coloring.hpp"

namespace clca::render {

/// Shades of the colour map, finer than visible steps.
inline constexpr std::size_t kMapShades = 1025;
/// Number of id colours before they repeat: three tints in turn, times a Fibonacci number of
/// golden-ratio steps, which close the circle to 1/2000.
inline constexpr std::size_t kIdShades = std::size_t{3} * 987;

/// Shade of a present particle.
struct Shading {
  const grains::State& state;
  const grains::Occupancy& occupancy;

  std::size_t shade(const BySpecies& /*rule*/, std::size_t id) const {
    return state.kinds[state.particles[id].kind].species;
  }
  std::size_t shade(const BySpeed& /*rule*/, std::size_t id) const {
    return state.particles[id].previous == grains::kRest ? 1 : 0;
  }
  static std::size_t shade(const ById& /*rule*/, std::size_t id) { return id % kIdShades; }
  std::size_t shade(const ByForce& /*rule*/, std::size_t id) const {
    const grains::Particle& particle = state.particles[id];
    std::size_t shared = 0;
    for (const lattice::Axial part : state.shape(particle).sites()) {
      const std::size_t place = state.lattice.index(particle.site() + part);
      shared += occupancy.second_owner(place) == grains::kFree ? 0U : 1U;
    }
    return shared;
  }
  static std::size_t shade(const ByLoad& rule, std::size_t id) {
    const double share = std::clamp(rule.loads[id] / rule.high, 0.0, 1.0);
    return static_cast<std::size_t>(share * (kMapShades - 1));
  }
  std::size_t shade(const ByDisplacement& rule, std::size_t id) const {
    const lattice::Axial moved = state.particles[id].site() - state.origins[id];
    const double share = std::min(1.0, lattice::position(moved).norm() / rule.high);
    return static_cast<std::size_t>(share * (kMapShades - 1));
  }
  std::size_t shade(const ByLayer& rule, std::size_t id) const {
    const auto [low, high] = rule.range;
    const double height =
        0.5 * doubled_height(state.origins[id]) + rule.centroids[state.particles[id].kind];
    const double share = high > low ? (height - low) / (high - low) : 0;
    return static_cast<std::size_t>(
        std::clamp(share * rule.layers, 0.0, static_cast<double>(rule.layers - 1)));
  }
};

/// Values beyond the palette get its last colour.
inline std::size_t in_palette(std::size_t shade, std::size_t colors) {
  return std::min(shade, colors - 1);
}

}  // namespace clca::render
