#pragma once
// Colours for particles, safe for colour-blind readers.

#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "clca/fields/fields.hpp"
#include "clca/grains/occupancy.hpp"
#include "clca/grains/state.hpp"
#include "clca/render/image.hpp"
#include "clca/render/legend.hpp"

namespace clca::render {

/// Default colour of the species, layer or wall with this number (Okabe & Ito 2008, repeated).
Rgb palette_color(std::size_t number);

/// A perceptually uniform colour map (viridis) at `share` in [0, 1], clamped.
Rgb map_color(double share);

struct NamedColor {
  std::string name;
  Rgb color;
};

/// Heights of origins (State::origins), in lattice spacings; `low` above `high` where there is
/// none.
struct LayerRange {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();

  static constexpr auto fields() {
    return std::make_tuple(fields::field("low", &LayerRange::low),
                           fields::field("high", &LayerRange::high));
  }
};

/// Of the particles that are present, and of all that the `sources` (State::sources) may emit.
LayerRange layer_range(const grains::State& state, std::span<const std::size_t> sources = {});

// What tells the shade of a particle.
struct BySpecies {};
struct BySpeed {};
struct ById {};
struct ByForce {};
struct ByLoad {
  std::vector<double> loads;  ///< by id, grain weights
  double high = 1;            ///< where the last shade begins
};
struct ByDisplacement {
  double high = 1;  ///< lattice spacings, where the last shade begins
};
struct ByLayer {
  int layers = 1;
  LayerRange range;
  std::vector<double> centroids;  ///< heights above the reference site by kind, lattice spacings
};
using ShadeRule = std::variant<BySpecies, BySpeed, ById, ByForce, ByLoad, ByDisplacement, ByLayer>;

/// A particle has one of few colours, its shade, told by itself and its sites alone: a picture
/// needs no more of a state than the shades of those that it shows.
struct Coloring {
  ShadeRule rule;
  std::vector<Rgb> palette;  ///< by shade, at most kMostShades
  Legend legend;
};

inline constexpr std::size_t kMostShades = 32'000;

/// Of one particle. `occupancy`: of `state`.
Rgb color(const Coloring& coloring, const grains::State& state, const grains::Occupancy& occupancy,
          std::size_t id);

Coloring color_by_species(std::span<const grains::Kind> kinds, std::span<const NamedColor> species);
/// Horizontal layers of equal thickness by the height of the origins. What lies outside of `range`
/// has the colour of the lowest or the highest layer.
Coloring color_by_layer(std::span<const grains::Kind> kinds, int layers, const LayerRange& range);
/// Distance from the origin; the bar ends at `high` lattice spacings.
Coloring color_by_displacement(double high);
/// By the sites that a particle shares with another one or with a wall; the bar ends at `high`.
/// Particles that share none are pale.
Coloring color_by_force(int high);
/// By the sum of the normal forces on a particle, by id, in weights of a grain; the bar ends at
/// `high`.
Coloring color_by_load(std::vector<double> loads, double high);
/// Moving in the last step, or at rest.
Coloring color_by_speed();
/// Neighbouring ids well apart.
Coloring color_by_id();

}  // namespace clca::render
