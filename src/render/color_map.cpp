#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "clca/render/coloring.hpp"
#include "render/colors.hpp"
#include "render/samples.hpp"

namespace clca::render {

namespace {

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
  return mixed(unpacked(table[low]), unpacked(table[low + 1]), position - static_cast<double>(low));
}

}  // namespace

Rgb palette_color(std::size_t number) {
  return unpacked(kOkabeIto[number % kOkabeIto.size()]);
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
