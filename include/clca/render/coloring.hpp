#pragma once
// Colours for particles, safe for colour-blind readers.

#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "clca/grains/occupancy.hpp"
#include "clca/grains/state.hpp"
#include "clca/reflection/reflection.hpp"
#include "clca/render/image.hpp"
#include "clca/render/legend.hpp"
#include "clca/statistics/sample.hpp"

namespace clca::render {

/// Default colour of a species, layer or wall by number (Okabe & Ito 2008, cyclic).
Rgb palette_color(std::size_t number);

/// The perceptually uniform colour map viridis at `share` in [0, 1], clamped.
Rgb viridis_color(double share);

/// The colour of `value`, clamped to [-1, 1], in a map pale at 0, blue below and red above.
Rgb diverging_color(double value);

/// The colour of a colour bar, at a share of the way from its lower to its higher end.
Rgb bar_color(const Legend::ColorBar& bar, double share);

struct NamedColor {
  std::string name;
  Rgb color;
};

/// Range of the heights of origins (State::origins), in lattice spacings; empty if `low` > `high`.
struct LayerRange {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();

  CLCA_FIELDS(low, high);
};

/// Range over the present particles and all that the `sources` (State::sources) may emit.
LayerRange layer_range(const grains::State& state, std::span<const std::size_t> sources = {});

/// The colour of each particle, one of a palette.
struct Coloring {
  std::vector<std::uint16_t> palette_indices;  ///< by id: index into the palette; 0 of absent ones
  std::vector<Rgb> palette = {};
  Legend legend = {};
};

Coloring color_by_species(const grains::State& state, std::span<const NamedColor> species);
/// Horizontal layers of equal thickness by height of the origins. Outside `range`: the colour of
/// the lowest or highest layer.
Coloring color_by_layer(const grains::State& state, int layers, const LayerRange& range);

// Colours by a number. `range`: the values at the ends of the colour bar, low < high.

/// By distance from the origin, in lattice spacings.
Coloring color_by_displacement(const grains::State& state, const statistics::Range& range);
/// By the number of sites shared with other particles and walls. Particles that share none are
/// pale. `occupancy` belongs to `state`.
Coloring color_by_force(const grains::State& state, const grains::Occupancy& occupancy,
                        const statistics::Range& range);
/// By a number of each particle, by id. `label`: what it is, with its unit. `diverging`: for
/// numbers with a sign; 0 has the middle colour, whatever the range.
Coloring color_by_value(const grains::State& state, const std::vector<double>& values,
                        std::string label, const statistics::Range& range, bool diverging = false);

/// By id; neighbouring ids have distinct colours.
Coloring color_by_id(const grains::State& state);
/// By the axis of grains of the Baxter model.
Coloring color_by_axis(const grains::State& state);

}  // namespace clca::render
