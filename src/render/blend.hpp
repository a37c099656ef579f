#pragma once
// Blending of colours in integers: the same bits everywhere.

#include "clca/render/image.hpp"
#include "render/colors.hpp"

namespace clca::render {

/// Lays `ink` over `pixel`; `coverage` from 0 to 255.
inline void blend(Rgb& pixel, Rgb ink, unsigned coverage) {
  const auto mixed = [coverage](unsigned paper, unsigned color) {
    return static_cast<std::uint8_t>((paper * (255 - coverage) + color * coverage + 127) / 255);
  };
  pixel = {mixed(pixel.red, ink.red), mixed(pixel.green, ink.green), mixed(pixel.blue, ink.blue)};
}

/// A share as coverage: clamped, 0 for NaN.
inline unsigned coverage_of(double share) {
  // lround would cost more than the rest of the pixel.
  constexpr double kHalf = 0.5;
  const double scaled = 255 * (share < 1 ? share : 1.0) + kHalf;
  return share > 0 ? static_cast<unsigned>(scaled) : 0U;
}

/// `color` blended with this share of white.
inline Rgb faded(Rgb color, double share) {
  blend(color, kPaper, coverage_of(share));
  return color;
}

}  // namespace clca::render
