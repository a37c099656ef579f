#pragma once
// Fixed colours of a picture.

#include "clca/render/image.hpp"

namespace clca::render {

inline constexpr Rgb kPaper = {255, 255, 255};
inline constexpr Rgb kWallColor = {74, 78, 84};
inline constexpr Rgb kMovingWallColor = {112, 140, 86};
inline constexpr Rgb kInk = {28, 31, 36};
inline constexpr Rgb kPaleInk = {96, 102, 110};

/// Colour of the outline of `fill`; strength and channels in [0, 1]. Darker than the fill, but
/// lighter for very dark fills.
inline constexpr const char* kOutlineColorSource = R"(
vec3 outline_color(vec3 fill, float strength) {
  float lightness = dot(fill, vec3(0.299, 0.587, 0.114));
  return lightness < 0.25 ? mix(fill, vec3(1.0), 0.35 * strength) : fill * (1.0 - 0.45 * strength);
}
)";

/// The same of a colour with channels from 0 to 255.
Rgb outline_color(Rgb fill, double strength);

/// `color` with this share of `other`, from 0 to 1; NaN counts as 0.
Rgb mixed(Rgb color, Rgb other, double share);

}  // namespace clca::render
