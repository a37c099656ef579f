#include "clca/render/coloring.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "render/shade.hpp"

namespace clca::render {

namespace {

using grains::State;

Rgb mixed(Rgb color, Rgb other, double share) {
  const auto mix = [share](std::uint8_t from, std::uint8_t to) {
    return static_cast<std::uint8_t>(std::lround(from + share * (to - from)));
  };
  return {mix(color.red, other.red), mix(color.green, other.green), mix(color.blue, other.blue)};
}

/// Alternately dark and light along a colour map: adjacent layers differ in lightness, and every
/// layer has its own colour.
Rgb layer_color(int layer, int layers) {
  const double share = layers > 1 ? static_cast<double>(layer) / (layers - 1) : 0.0;
  const Rgb color = map_color(0.08 + 0.72 * share);
  return layer % 2 == 0 ? color : mixed(color, {255, 255, 255}, 0.55);
}

std::string layer_label(int layer, int layers) {
  const char* where = layer == 0 ? " (bottom)" : layer == layers - 1 ? " (top)" : "";
  return fmt::format("{}{}{}", layer == 0 ? "layer " : "", layer + 1, where);
}

std::vector<double> centroid_heights(std::span<const grains::Kind> kinds) {
  std::vector<double> heights;
  for (const grains::Kind& kind : kinds) {
    heights.push_back(kind.shape.centroid().y());
  }
  return heights;
}

Rgb id_color(std::size_t id) {
  // Steps of the golden ratio around the colour circle: recent colours are never close.
  constexpr double kGoldenRatio = 0.61803398874989484820;
  const double turn = static_cast<double>(id) * kGoldenRatio;
  const double place = (turn - std::floor(turn)) * 7;
  const auto number = static_cast<std::size_t>(place);
  const Rgb color = mixed(palette_color(number), palette_color((number + 1) % 7),
                          place - static_cast<double>(number));
  return mixed(color, {255, 255, 255}, id % 3 == 0 ? 0.0 : id % 3 == 1 ? 0.3 : 0.15);
}

std::vector<Rgb> whole_map() {
  std::vector<Rgb> palette;
  for (std::size_t shade = 0; shade < kMapShades; ++shade) {
    palette.push_back(map_color(static_cast<double>(shade) / (kMapShades - 1)));
  }
  return palette;
}

}  // namespace

Rgb color(const Coloring& coloring, const State& state, const grains::Occupancy& occupancy,
          std::size_t id) {
  const Shading shading = {state, occupancy};
  const std::size_t shade =
      std::visit([&](const auto& rule) { return shading.shade(rule, id); }, coloring.rule);
  return coloring.palette[in_palette(shade, coloring.palette.size())];
}

Coloring color_by_species(std::span<const grains::Kind> kinds,
                          std::span<const NamedColor> species) {
  Coloring result = {.rule = BySpecies{}, .palette = {}, .legend = {}};
  for (const NamedColor& named : species) {
    result.palette.push_back(named.color);
    result.legend.patches.push_back({named.name, named.color});
  }
  for (const grains::Kind& kind : kinds) {
    while (result.palette.size() <= kind.species) {
      result.palette.push_back(palette_color(result.palette.size()));
    }
  }
  return result;
}

LayerRange layer_range(const State& state, std::span<const std::size_t> sources) {
  const std::vector<double> centroids = centroid_heights(state.kinds);
  LayerRange range;
  const auto add = [&](lattice::Site origin, std::size_t kind) {
    const double height = lattice::position(origin).y() + centroids[kind];
    range.low = std::min(range.low, height);
    range.high = std::max(range.high, height);
  };
  for (std::size_t id = 0; id < state.particles.size(); ++id) {
    if (state.particles[id].present) {
      add(state.origins[id], state.particles[id].kind);
    }
  }
  for (const std::size_t number : sources) {
    const grains::Source& source = state.sources[number];
    for (std::size_t kind = 0; kind < source.weights.size(); ++kind) {
      for (const lattice::Site site : source.sites) {
        if (source.weights[kind] > 0) {
          add(site, kind);
        }
      }
    }
  }
  return range;
}

Coloring color_by_layer(std::span<const grains::Kind> kinds, int layers, const LayerRange& range) {
  if (layers < 1) {
    throw std::invalid_argument("there is at least one layer");
  }
  Coloring result = {
      .rule = ByLayer{layers, range, centroid_heights(kinds)}, .palette = {}, .legend = {}};
  for (int layer = 0; layer < layers; ++layer) {
    result.palette.push_back(layer_color(layer, layers));
    result.legend.patches.push_back({layer_label(layer, layers), result.palette.back()});
  }
  return result;
}

Coloring color_by_displacement(double high) {
  if (!(high > 0)) {
    throw std::invalid_argument("the displacement at the end of the colour bar is positive");
  }
  Coloring result = {.rule = ByDisplacement{high}, .palette = whole_map(), .legend = {}};
  result.legend.bars.push_back({"displacement (spacings)", 0, high});
  return result;
}

Coloring color_by_force(int high) {
  constexpr Rgb kFree = {228, 230, 233};
  constexpr int kMaxForceIndex = 1000;
  if (high < 1 || high > kMaxForceIndex) {
    throw std::invalid_argument("the force at the end of the colour bar is 1 to 1000 sites");
  }
  Coloring result = {.rule = ByForce{}, .palette = {kFree}, .legend = {}};
  for (int sites = 1; sites <= high; ++sites) {
    result.palette.push_back(map_color(static_cast<double>(sites) / high));
  }
  result.legend.bars.push_back({"overlapped sites", 0, static_cast<double>(high)});
  result.legend.patches.push_back({"none", kFree});
  return result;
}

Coloring color_by_load(std::vector<double> loads, double high) {
  if (!(high > 0)) {
    throw std::invalid_argument("the load at the end of the colour bar is positive");
  }
  Coloring result = {.rule = ByLoad{std::move(loads), high}, .palette = whole_map(), .legend = {}};
  result.legend.bars.push_back({"load (grain weights)", 0, high});
  return result;
}

Coloring color_by_speed() {
  constexpr Rgb kMoving = {213, 94, 0};
  constexpr Rgb kResting = {176, 196, 214};
  Coloring result = {.rule = BySpeed{}, .palette = {kMoving, kResting}, .legend = {}};
  result.legend.patches = {{"moving", kMoving}, {"at rest", kResting}};
  return result;
}

Coloring color_by_id() {
  Coloring result = {.rule = ById{}, .palette = {}, .legend = {}};
  for (std::size_t id = 0; id < kIdShades; ++id) {
    result.palette.push_back(id_color(id));
  }
  return result;
}

}  // namespace clca::render
