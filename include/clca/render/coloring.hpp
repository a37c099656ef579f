#pragma once
// Colours for particles, safe for colour-blind readers.

#include <limits>
#include <span>
#include <string>
#include <vector>

#include "clca/automaton/state.hpp"
#include "clca/fields/fields.hpp"
#include "clca/render/painter.hpp"

namespace clca::render {

/// Default colour of the species, layer or wall with this number (Okabe & Ito 2008, repeated).
Rgb palette_color(std::size_t number);

/// A perceptually uniform colour map (viridis) at `share` in [0, 1], clamped.
Rgb map_color(double share);

struct NamedColor {
  std::string name;
  Rgb color;
};

Coloring color_by_species(const automaton::State& state, std::span<const NamedColor> species);
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

/// Of the particles that are present.
LayerRange layer_range(const automaton::State& state);

/// Horizontal layers of equal thickness by the height of the origins: between the lowest and the
/// highest of those that are present, and of those that were when the stage began (`begin`), so
/// that particles that leave change no colour.
Coloring color_by_layer(const automaton::State& state, int layers, const LayerRange& begin = {});
/// Distance from the origin; the bar ends at `high` lattice spacings.
Coloring color_by_displacement(const automaton::State& state, double high);
/// Overlapped sites by particle id, after a force index; the bar ends at `high`. Particles without
/// any are pale.
Coloring color_by_force(const automaton::State& state, std::span<const double> index, double high);
/// Moving in the last step, or at rest.
Coloring color_by_speed(const automaton::State& state);
/// Neighbouring ids well apart.
Coloring color_by_id(const automaton::State& state);

}  // namespace clca::render
