#include "clca/render/coloring.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "clca/render/body.hpp"
#include "render/colors.hpp"
#include "render/shade.hpp"

namespace clca::render {

namespace {

using grains::State;

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
  const double position = (turn - std::floor(turn)) * 7;
  const auto number = static_cast<std::size_t>(position);
  const Rgb color = mixed(palette_color(number), palette_color((number + 1) % 7),
                          position - static_cast<double>(number));
  return mixed(color, {255, 255, 255}, id % 3 == 0 ? 0.0 : id % 3 == 1 ? 0.3 : 0.15);
}

Coloring by_map(ShadeRule rule, std::string label, const statistics::Range& range,
                bool diverging = false) {
  if (!(range.low < range.high && std::isfinite(range.high - range.low))) {
    throw std::invalid_argument("a colour bar goes from a lower to a higher value");
  }
  Coloring result = {.rule = std::move(rule), .palette = {}, .legend = {}};
  result.legend.bars = {
      {.label = std::move(label), .low = range.low, .high = range.high, .diverging = diverging}};
  for (std::size_t shade = 0; shade < kMapShades; ++shade) {
    result.palette.push_back(
        bar_color(result.legend.bars[0], static_cast<double>(shade) / (kMapShades - 1)));
  }
  return result;
}

/// Icons of all species: their first shapes, the smaller ones smaller.
std::vector<Legend::Patch> species_icons(std::span<const grains::Kind> kinds,
                                         std::span<const NamedColor> species) {
  constexpr double kSmallest = 0.6;
  std::vector<Legend::Patch> icons;
  double largest = 0;
  for (std::size_t number = 0; number < species.size(); ++number) {
    Legend::Patch icon = {.label = species[number].name, .color = species[number].color};
    const auto first = std::ranges::find_if(
        kinds, [&](const grains::Kind& kind) { return kind.species == number; });
    if (first != kinds.end()) {
      const std::vector<Outline> bodies = outlines(first->shape);
      for (const GridPoint corner : bodies.front()) {
        icon.outline.push_back(position(corner));
      }
      icon.size = first->shape.diameter();
      largest = std::max(largest, icon.size);
    }
    icons.push_back(std::move(icon));
  }
  for (Legend::Patch& icon : icons) {
    icon.size = icon.outline.empty() ? 1 : std::max(kSmallest, icon.size / largest);
  }
  return icons;
}

}  // namespace

Rgb color(const Coloring& coloring, const State& state, const grains::Occupancy& occupancy,
          std::size_t id) {
  const Shading shading = {state, occupancy};
  const std::size_t shade =
      std::visit([&](const auto& rule) { return shading.shade(rule, id); }, coloring.rule);
  return coloring.palette[in_palette(shade, coloring.palette.size())];
}

void mark_beyond(Coloring& coloring, const State& state, const grains::Occupancy& occupancy) {
  const Shading shading = {state, occupancy};
  std::visit(
      [&](const auto& rule) {
        if constexpr (requires { rule.range.low < shading.value(rule, 0); }) {
          Legend::Bar& bar = coloring.legend.bars.front();
          for (std::size_t id = 0; id < state.particles.size(); ++id) {
            if (state.particles[id].present) {
              const double value = shading.value(rule, id);
              bar.below = bar.below || value < rule.range.low;
              bar.above = bar.above || value > rule.range.high;
            }
          }
        }
      },
      coloring.rule);
}

Coloring color_by_species(std::span<const grains::Kind> kinds,
                          std::span<const NamedColor> species) {
  Coloring result = {.rule = BySpecies{}, .palette = {}, .legend = {}};
  for (const NamedColor& named : species) {
    result.palette.push_back(named.color);
  }
  result.legend.patches = species_icons(kinds, species);
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

Coloring color_by_displacement(const statistics::Range& range) {
  return by_map(ByDisplacement{range}, "displacement (spacings)", range);
}

Coloring color_by_force(const statistics::Range& range) {
  constexpr Rgb kNone = {228, 230, 233};
  Coloring result = by_map(ByForce{range}, "overlapped sites", range);
  result.palette.insert(result.palette.begin(), kNone);
  result.legend.patches.push_back({"none", kNone});
  return result;
}

Coloring color_by_value(std::vector<double> values, std::string label,
                        const statistics::Range& range, bool diverging) {
  return by_map(ByValue{std::move(values), range}, std::move(label), range, diverging);
}

Coloring color_by_axis() {
  Coloring result = {.rule = ByAxis{}, .palette = {}, .legend = {}};
  for (const char* axis : {"axis upright", "60°", "120°"}) {
    result.palette.push_back(palette_color(result.palette.size()));
    result.legend.patches.push_back({axis, result.palette.back()});
  }
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
