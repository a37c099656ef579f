#pragma once
// From the plane of the lattice to the samples of the canvas.

#include <algorithm>
#include <cmath>

#include "clca/lattice/region.hpp"
#include "clca/render/body.hpp"
#include "clca/render/image.hpp"

namespace clca::render {

/// A particle in view.
struct Body {
  std::uint16_t kind = 0;
  GridPoint place;  ///< of the reference site
  Rgb fill;
};

struct Projection {
  int width = 0;  ///< samples
  int height = 0;
  double scale = 1;             ///< samples a lattice spacing
  Eigen::Vector2d corner;       ///< of the canvas, lower left, in lattice spacings
  double outline_width = 0;     ///< lattice spacings
  double outline_strength = 0;  ///< 0 draws no outline, 1 the darkest one

  /// The part of the plane that the canvas shows.
  lattice::Rectangle view() const {
    return {corner.x(), corner.y(), corner.x() + width / scale, corner.y() + height / scale};
  }

  /// The samples whose centre lies in `rectangle`, the lower left one first.
  PixelBox samples_in(const lattice::Rectangle& rectangle) const {
    const auto first = [](double coordinate, int count) {
      return static_cast<int>(
          std::clamp(std::ceil(coordinate - 0.5), 0.0, static_cast<double>(count)));
    };
    const int left = first((rectangle.left - corner.x()) * scale, width);
    const int right = first((rectangle.right - corner.x()) * scale, width);
    const int bottom = first((rectangle.bottom - corner.y()) * scale, height);
    const int top = first((rectangle.top - corner.y()) * scale, height);
    return {left, bottom, std::max(0, right - left), std::max(0, top - bottom)};
  }
};

}  // namespace clca::render
