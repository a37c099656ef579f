#pragma once
// The shade of a particle by each rule: an index into the palette of its colouring.

#include <algorithm>

#include "clca/baxter/baxter_model.hpp"
#include "clca/render/coloring.hpp"

namespace clca::render {

/// Shades of the colour map, finer than visible steps.
inline constexpr std::size_t kMapShades = 1025;
/// Number of id colours before they repeat: three tints in turn, times a Fibonacci number of
/// golden-ratio steps, which close the circle to 1/2000.
inline constexpr std::size_t kIdShades = std::size_t{3} * 987;

/// Shade of a present particle, and the value that a colour bar shows.
struct Shading {
  const grains::State& state;
  const grains::Occupancy& occupancy;

  std::size_t shade(const BySpecies& /*rule*/, std::size_t id) const {
    return state.kinds[state.particles[id].kind].species;
  }
  std::size_t shade(const ByAxis& /*rule*/, std::size_t id) const {
    return baxter::axis_of(state.particles[id]);
  }
  static std::size_t shade(const ById& /*rule*/, std::size_t id) { return id % kIdShades; }
  /// No colour of the map for no sites.
  std::size_t shade(const ByForce& rule, std::size_t id) const {
    const double sites = value(rule, id);
    return sites > 0 ? 1 + map_shade(rule.range, sites) : 0;
  }
  static std::size_t shade(const ByValue& rule, std::size_t id) {
    return map_shade(rule.range, value(rule, id));
  }
  std::size_t shade(const ByDisplacement& rule, std::size_t id) const {
    return map_shade(rule.range, value(rule, id));
  }
  std::size_t shade(const ByLayer& rule, std::size_t id) const {
    const auto [low, high] = rule.range;
    const double height =
        0.5 * doubled_height(state.origins[id]) + rule.centroids[state.particles[id].kind];
    const double share = high > low ? (height - low) / (high - low) : 0;
    return static_cast<std::size_t>(
        std::clamp(share * rule.layers, 0.0, static_cast<double>(rule.layers - 1)));
  }

  double value(const ByForce& /*rule*/, std::size_t id) const {
    const grains::Particle& particle = state.particles[id];
    int shared = 0;
    for (const lattice::Axial part : state.shape(particle).sites()) {
      const std::size_t index = state.lattice.index(particle.site() + part);
      shared += occupancy.second_owner(index) == grains::kFree ? 0 : 1;
    }
    return shared;
  }
  static double value(const ByValue& rule, std::size_t id) { return rule.values[id]; }
  double value(const ByDisplacement& /*rule*/, std::size_t id) const {
    return lattice::position(state.particles[id].site() - state.origins[id]).norm();
  }

 private:
  static std::size_t map_shade(const statistics::Range& range, double value) {
    const double share = std::clamp((value - range.low) / (range.high - range.low), 0.0, 1.0);
    return static_cast<std::size_t>(share * (kMapShades - 1));
  }
};

/// Values beyond the palette get its last colour.
inline std::size_t in_palette(std::size_t shade, std::size_t colors) {
  return std::min(shade, colors - 1);
}

}  // namespace clca::render
