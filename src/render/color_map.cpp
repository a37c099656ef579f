#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "clca/render/coloring.hpp"
#include "render/colors.hpp"

namespace clca::render {

namespace {

// Okabe & Ito 2008, "Color Universal Design", without black, the soft colours first.
constexpr std::array<Rgb, 8> kOkabeIto = {{{86, 180, 233},
                                           {230, 159, 0},
                                           {0, 158, 115},
                                           {213, 94, 0},
                                           {0, 114, 178},
                                           {204, 121, 167},
                                           {240, 228, 66},
                                           {153, 153, 153}}};

// van der Walt & Smith 2015, "A better default colormap for Matplotlib" (viridis): every
// seventeenth of its 256 entries.
constexpr std::array<Rgb, 16> kViridis = {{{68, 1, 84},
                                           {72, 26, 108},
                                           {71, 47, 125},
                                           {65, 68, 135},
                                           {57, 86, 140},
                                           {49, 104, 142},
                                           {42, 120, 142},
                                           {35, 136, 142},
                                           {31, 152, 139},
                                           {34, 168, 132},
                                           {53, 183, 121},
                                           {84, 197, 104},
                                           {122, 209, 81},
                                           {165, 219, 54},
                                           {210, 226, 27},
                                           {253, 231, 37}}};

// Moreland 2009, "Diverging color maps for scientific visualization": every sixteenth of its 257
// entries.
constexpr std::array<Rgb, 17> kCoolToWarm = {{{59, 76, 192},
                                              {77, 104, 215},
                                              {98, 130, 234},
                                              {119, 154, 247},
                                              {141, 176, 254},
                                              {163, 194, 255},
                                              {184, 208, 249},
                                              {204, 217, 238},
                                              {221, 221, 221},
                                              {236, 211, 197},
                                              {245, 196, 173},
                                              {247, 177, 148},
                                              {244, 154, 123},
                                              {236, 127, 99},
                                              {222, 96, 77},
                                              {203, 62, 56},
                                              {180, 4, 38}}};

/// No value, not even NaN, may index outside the table.
Rgb interpolated(std::span<const Rgb> table, double share) {
  const double position =
      share > 0 ? std::min(share, 1.0) * static_cast<double>(table.size() - 1) : 0.0;
  const auto low = std::min(static_cast<std::size_t>(position), table.size() - 2);
  return mixed(table[low], table[low + 1], position - static_cast<double>(low));
}

}  // namespace

Rgb palette_color(std::size_t number) {
  return kOkabeIto[number % kOkabeIto.size()];
}

Rgb map_color(double share) {
  return interpolated(kViridis, share);
}

Rgb diverging_color(double value) {
  return interpolated(kCoolToWarm, (1 + value) / 2);
}

Rgb bar_color(const Legend::Bar& bar, double share) {
  const double value = bar.low + share * (bar.high - bar.low);
  return bar.diverging ? diverging_color(value / std::max(std::abs(bar.low), std::abs(bar.high)))
                       : map_color(share);
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

}  // namespace clca::render
