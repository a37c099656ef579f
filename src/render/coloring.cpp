#include "clca/render/coloring.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace clca::render {

namespace {

using automaton::Particle;
using automaton::State;

template <class ColorOf>
std::vector<Rgb> colors_by_id(const State& state, ColorOf color_of) {
  std::vector<Rgb> colors;
  colors.reserve(state.particles.size());
  for (std::size_t id = 0; id < state.particles.size(); ++id) {
    colors.push_back(color_of(id));
  }
  return colors;
}

Rgb mixed(Rgb color, Rgb other, double share) {
  const auto mix = [share](std::uint8_t from, std::uint8_t to) {
    return static_cast<std::uint8_t>(std::lround(from + share * (to - from)));
  };
  return {mix(color.red, other.red), mix(color.green, other.green), mix(color.blue, other.blue)};
}

/// Dark and light by turns, along a colour map: layers that touch differ in lightness, and each
/// still has a colour of its own.
Rgb layer_color(int layer, int layers) {
  const double share = layers > 1 ? static_cast<double>(layer) / (layers - 1) : 0.0;
  const Rgb color = map_color(0.08 + 0.72 * share);
  return layer % 2 == 0 ? color : mixed(color, {255, 255, 255}, 0.55);
}

std::string layer_label(int layer, int layers) {
  const char* where = layer == 0 ? " (bottom)" : layer == layers - 1 ? " (top)" : "";
  return fmt::format("{}{}{}", layer == 0 ? "layer " : "", layer + 1, where);
}

double origin_height(const State& state, std::size_t id) {
  const Particle& particle = state.particles[id];
  return lattice::position(state.origins[id]).y() + state.shape(particle).centroid().y();
}

}  // namespace

Coloring color_by_species(const State& state, std::span<const NamedColor> species) {
  const auto color_of = [&](std::size_t number) {
    return number < species.size() ? species[number].color : palette_color(number);
  };
  Coloring result;
  result.colors = colors_by_id(state, [&](std::size_t id) {
    return color_of(state.kinds[state.particles[id].kind].species);
  });
  for (const NamedColor& named : species) {
    result.legend.patches.push_back({named.name, named.color});
  }
  return result;
}

LayerRange layer_range(const State& state) {
  LayerRange range;
  for (std::size_t id = 0; id < state.particles.size(); ++id) {
    if (state.particles[id].present) {
      const double height = origin_height(state, id);
      range.low = std::min(range.low, height);
      range.high = std::max(range.high, height);
    }
  }
  return range;
}

Coloring color_by_layer(const State& state, int layers, const LayerRange& begin) {
  if (layers < 1) {
    throw std::invalid_argument("there is at least one layer");
  }
  const LayerRange now = layer_range(state);
  const double low = std::min(begin.low, now.low);
  const double high = std::max(begin.high, now.high);
  Coloring result;
  result.colors = colors_by_id(state, [&](std::size_t id) {
    const bool told = state.particles[id].present && high > low;
    const double share = told ? (origin_height(state, id) - low) / (high - low) : 0.0;
    return layer_color(std::min(static_cast<int>(share * layers), layers - 1), layers);
  });
  for (int layer = 0; layer < layers; ++layer) {
    result.legend.patches.push_back({layer_label(layer, layers), layer_color(layer, layers)});
  }
  return result;
}

Coloring color_by_displacement(const State& state, double high) {
  if (!(high > 0)) {
    throw std::invalid_argument("the displacement at the end of the colour bar is positive");
  }
  Coloring result;
  result.colors = colors_by_id(state, [&](std::size_t id) {
    const lattice::Axial moved = state.particles[id].site() - state.origins[id];
    return map_color(lattice::position(moved).norm() / high);
  });
  result.legend.bars.push_back({"displacement (spacings)", 0, high});
  return result;
}

Coloring color_by_force(const State& state, std::span<const double> index, double high) {
  constexpr Rgb kFree = {228, 230, 233};
  if (!(high > 0)) {
    throw std::invalid_argument("the force at the end of the colour bar is positive");
  }
  if (index.size() < state.particles.size()) {
    throw std::invalid_argument("a colouring by force needs one index for each particle");
  }
  Coloring result;
  result.colors = colors_by_id(
      state, [&](std::size_t id) { return index[id] > 0 ? map_color(index[id] / high) : kFree; });
  result.legend.bars.push_back({"overlapped sites", 0, high});
  result.legend.patches.push_back({"none", kFree});
  return result;
}

Coloring color_by_speed(const State& state) {
  constexpr Rgb kMoving = {213, 94, 0};
  constexpr Rgb kResting = {176, 196, 214};
  Coloring result;
  result.colors = colors_by_id(state, [&](std::size_t id) {
    return state.particles[id].previous == automaton::kRest ? kResting : kMoving;
  });
  result.legend.patches = {{"moving", kMoving}, {"at rest", kResting}};
  return result;
}

Coloring color_by_id(const State& state) {
  // Steps of the golden ratio round a circle never come close to a step shortly before.
  constexpr double kGoldenRatio = 0.61803398874989484820;
  Coloring result;
  result.colors = colors_by_id(state, [&](std::size_t id) {
    const double turn = static_cast<double>(id) * kGoldenRatio;
    const double place = (turn - std::floor(turn)) * 7;
    const auto number = static_cast<std::size_t>(place);
    const Rgb color = mixed(palette_color(number), palette_color((number + 1) % 7),
                            place - static_cast<double>(number));
    return mixed(color, {255, 255, 255}, id % 3 == 0 ? 0.0 : id % 3 == 1 ? 0.3 : 0.15);
  });
  return result;
}

}  // namespace clca::render
