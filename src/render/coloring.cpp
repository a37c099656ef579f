#include "clca/render/coloring.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "clca/baxter/baxter_model.hpp"
#include "clca/render/body.hpp"
#include "render/colors.hpp"
#include "render/samples.hpp"

namespace clca::render {

namespace {

using grains::State;

// Okabe & Ito 2008, "Color Universal Design", without black, the soft colours first.
constexpr std::array<Sample, 8> kOkabeIto = {0x56B4E9, 0xE69F00, 0x009E73, 0xD55E00,
                                             0x0072B2, 0xCC79A7, 0xF0E442, 0x999999};

// van der Walt & Smith 2015, "A better default colormap for Matplotlib" (viridis): every
// seventeenth of its 256 entries.
constexpr std::array<Sample, 16> kViridis = {
    0x440154, 0x481A6C, 0x472F7D, 0x414487, 0x39568C, 0x31688E, 0x2A788E, 0x23888E,
    0x1F988B, 0x22A884, 0x35B779, 0x54C568, 0x7AD151, 0xA5DB36, 0xD2E21B, 0xFDE725};

// Moreland 2009, "Diverging color maps for scientific visualization": every sixteenth of its 257
// entries.
constexpr std::array<Sample, 17> kCoolToWarm = {
    0x3B4CC0, 0x4D68D7, 0x6282EA, 0x779AF7, 0x8DB0FE, 0xA3C2FF, 0xB8D0F9, 0xCCD9EE, 0xDDDDDD,
    0xECD3C5, 0xF5C4AD, 0xF7B194, 0xF49A7B, 0xEC7F63, 0xDE604D, 0xCB3E38, 0xB40426};

/// No value, not even NaN, may index outside the table.
Rgb interpolated(std::span<const Sample> table, double share) {
  const double position =
      share > 0 ? std::min(share, 1.0) * static_cast<double>(table.size() - 1) : 0.0;
  const auto low = std::min(static_cast<std::size_t>(position), table.size() - 2);
  return mixed(to_rgb(table[low]), to_rgb(table[low + 1]), position - static_cast<double>(low));
}

/// Alternately dark and light along a colour map: adjacent layers differ in lightness, and every
/// layer has its own colour.
Rgb layer_color(int layer, int layers) {
  const double share = layers > 1 ? static_cast<double>(layer) / (layers - 1) : 0.0;
  const Rgb color = viridis_color(0.08 + 0.72 * share);
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

/// What `value_of` says of each present particle, by id.
template <class Value, class ValueOf>
std::vector<Value> values_by_id(const State& state, ValueOf value_of) {
  std::vector<Value> values(state.particles.size());
  for (std::size_t id = 0; id < values.size(); ++id) {
    if (state.particles[id].present) {
      values[id] = static_cast<Value>(value_of(id));
    }
  }
  return values;
}

/// Icons of all species: their first shapes, the smaller ones smaller.
std::vector<Legend::Patch> species_icons(std::span<const grains::Kind> kinds,
                                         std::span<const NamedColor> species) {
  constexpr double kSmallest = 0.6;  // icon, as a share of the largest
  std::vector<Legend::Patch> icons;
  double largest = 0;
  for (std::size_t number = 0; number < species.size(); ++number) {
    Legend::Patch icon = {.label = species[number].name, .color = species[number].color};
    const auto first = std::ranges::find_if(
        kinds, [&](const grains::Kind& kind) { return kind.species == number; });
    if (first != kinds.end()) {
      for (const lattice::Axial corner : outline(first->shape)) {
        icon.outline.push_back(position_from_halves(corner));
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

Rgb palette_color(std::size_t number) {
  return to_rgb(kOkabeIto[number % kOkabeIto.size()]);
}

Rgb viridis_color(double share) {
  return interpolated(kViridis, share);
}

Rgb diverging_color(double value) {
  return interpolated(kCoolToWarm, (1 + value) / 2);
}

Rgb bar_color(const Legend::ColorBar& bar, double share) {
  const double value = bar.low + share * (bar.high - bar.low);
  return bar.diverging ? diverging_color(value / std::max(std::abs(bar.low), std::abs(bar.high)))
                       : viridis_color(share);
}

Rgb mixed(Rgb color, Rgb other, double share) {
  const double part = share > 0 ? std::min(share, 1.0) : 0.0;
  const auto mix = [part](std::uint8_t from, std::uint8_t to) {
    return static_cast<std::uint8_t>(std::lround(from + part * (to - from)));
  };
  return {mix(color.red, other.red), mix(color.green, other.green), mix(color.blue, other.blue)};
}

Rgb outline_color(Rgb fill, double strength) {
  const bool dark = 0.299 * fill.red + 0.587 * fill.green + 0.114 * fill.blue < 0.25 * 255;
  const auto shaded = [dark, strength](std::uint8_t channel) {
    const double towards = dark ? 0.35 * strength * (255 - channel) : -0.45 * strength * channel;
    return static_cast<std::uint8_t>(std::lround(channel + towards));
  };
  return {shaded(fill.red), shaded(fill.green), shaded(fill.blue)};
}

Coloring color_by_species(const State& state, std::span<const NamedColor> species) {
  Coloring result = {.palette_indices = values_by_id<std::uint16_t>(state, [&](std::size_t id) {
                       return state.kinds[state.particles[id].kind].species;
                     })};
  for (const NamedColor& named : species) {
    result.palette.push_back(named.color);
  }
  result.legend.patches = species_icons(state.kinds, species);
  for (const grains::Kind& kind : state.kinds) {
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

Coloring color_by_layer(const State& state, int layers, const LayerRange& range) {
  constexpr int kMost = std::numeric_limits<std::uint16_t>::max();  // of shades
  if (layers < 1 || layers > kMost) {
    throw std::invalid_argument(fmt::format("there are 1 to {} layers", kMost));
  }
  const std::vector<double> centroids = centroid_heights(state.kinds);
  const auto layer_of = [&](std::size_t id) {
    const double height =
        lattice::position(state.origins[id]).y() + centroids[state.particles[id].kind];
    const double share =
        range.high > range.low ? (height - range.low) / (range.high - range.low) : 0;
    return std::clamp(share * layers, 0.0, static_cast<double>(layers - 1));
  };
  Coloring result = {.palette_indices = values_by_id<std::uint16_t>(state, layer_of)};
  for (int layer = 0; layer < layers; ++layer) {
    result.palette.push_back(layer_color(layer, layers));
    result.legend.patches.push_back({layer_label(layer, layers), result.palette.back()});
  }
  return result;
}

Coloring color_by_value(const State& state, const std::vector<double>& values, std::string label,
                        const statistics::Range& range, bool diverging) {
  constexpr int kShades = 1025;  // finer than visible steps
  if (!(range.low < range.high && std::isfinite(range.high - range.low))) {
    throw std::invalid_argument("a colour bar goes from a lower to a higher value");
  }
  Legend::ColorBar bar = {
      .label = std::move(label), .low = range.low, .high = range.high, .diverging = diverging};
  Coloring result;
  result.palette_indices = values_by_id<std::uint16_t>(state, [&](std::size_t id) {
    bar.below = bar.below || values[id] < range.low;
    bar.above = bar.above || values[id] > range.high;
    return (kShades - 1) *
           std::clamp((values[id] - range.low) / (range.high - range.low), 0.0, 1.0);
  });
  for (int shade = 0; shade < kShades; ++shade) {
    result.palette.push_back(bar_color(bar, shade / (kShades - 1.0)));
  }
  result.legend.bars = {std::move(bar)};
  return result;
}

Coloring color_by_displacement(const State& state, const statistics::Range& range) {
  const auto distances = values_by_id<double>(state, [&](std::size_t id) {
    return lattice::position(state.particles[id].site() - state.origins[id]).norm();
  });
  return color_by_value(state, distances, "displacement (spacings)", range);
}

Coloring color_by_force(const State& state, const grains::Occupancy& occupancy,
                        const statistics::Range& range) {
  constexpr Rgb kNone = {228, 230, 233};
  const auto shared = values_by_id<double>(state, [&](std::size_t id) {
    const grains::Particle& particle = state.particles[id];
    return std::ranges::count_if(state.shape(particle).sites(), [&](lattice::Axial part) {
      const std::size_t index = state.lattice.index(particle.site() + part);
      return occupancy.second_owner(index) != grains::kFree;
    });
  });
  Coloring result = color_by_value(state, shared, "overlapped sites", range);
  for (std::size_t id = 0; id < shared.size(); ++id) {
    result.palette_indices[id] =
        static_cast<std::uint16_t>(shared[id] > 0 ? result.palette_indices[id] + 1 : 0);
  }
  result.palette.insert(result.palette.begin(), kNone);
  result.legend.patches.push_back({"none", kNone});
  return result;
}

Coloring color_by_axis(const State& state) {
  Coloring result = {.palette_indices = values_by_id<std::uint16_t>(state, [&](std::size_t id) {
                       return baxter::axis_of(state.particles[id]);
                     })};
  for (const char* axis : {"axis upright", "60°", "120°"}) {
    result.palette.push_back(palette_color(result.palette.size()));
    result.legend.patches.push_back({axis, result.palette.back()});
  }
  return result;
}

Coloring color_by_id(const State& state) {
  // Ids before the colours repeat: three tints in turn, times a Fibonacci number of golden-ratio
  // steps, which close the circle to 1/2000.
  constexpr std::size_t kShades = std::size_t{3} * 987;
  Coloring result = {.palette_indices = values_by_id<std::uint16_t>(
                         state, [](std::size_t id) { return id % kShades; })};
  for (std::size_t id = 0; id < kShades; ++id) {
    result.palette.push_back(id_color(id));
  }
  return result;
}

}  // namespace clca::render
