#pragma once
// Fixed colours of a picture.

#include "clca/render/image.hpp"

namespace clca::render {

inline constexpr Rgb kPaper = {255, 255, 255};
inline constexpr Rgb kWallColor = {74, 78, 84};
inline constexpr Rgb kMovingWallColor = {112, 140, 86};
inline constexpr Rgb kInk = {28, 31, 36};
inline constexpr Rgb kPaleInk = {96, 102, 110};

/// Colour of the outline of `fill`, strength from 0 to 1. Darker than the fill, but lighter for
/// very dark fills.
Rgb outline_color(Rgb fill, double strength);

/// `color` with this share of `other`, from 0 to 1; NaN counts as 0.
Rgb mixed(Rgb color, Rgb other, double share);

}  // namespace clca::render
