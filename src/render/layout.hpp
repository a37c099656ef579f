#pragma once
// Layout of view and annotations in a picture; the part of the plane that the view shows, and its
// projection to the samples of the canvas.

#include <algorithm>
#include <cmath>

#include "clca/lattice/region.hpp"
#include "clca/render/body.hpp"
#include "clca/render/painter.hpp"

namespace clca::render {

struct Layout {
  PixelBox panel;  ///< shows the view
  double pixels_per_spacing = 1;
  int text_size = 0;  ///< pixels; 0: no annotations, or no room for them
  int text_left = 0;  ///< bounds of captions and legends
  int text_right = 0;
  bool has_captions = true;
  bool has_scale_bar = true;
};

/// A size in which the view fills the picture, with space for annotations if requested: even
/// numbers, an area of about 1280 x 720. What is given (not 0) is kept, the other follows. The box
/// is at 0, 0.
PixelBox picture_size(int width, int height, const lattice::Rectangle& view,
                      Annotations annotations);

/// Fits `view` into a picture of width x height pixels, with space for annotations if requested.
Layout layout_of(int width, int height, const lattice::Rectangle& view, Annotations annotations);

/// `style` with its view, or the whole box if it has none, and its size. Throws RenderError for an
/// invalid style.
Style with_view_and_size(Style style, const lattice::Lattice& lattice);

struct Body {
  std::uint16_t kind = 0;
  lattice::Axial place;  ///< of the reference site, in half spacings from site 0, 0
  Rgb fill;
};

struct Projection {
  int width = 0;  ///< samples
  int height = 0;
  double samples_per_spacing = 1;
  Eigen::Vector2d corner;       ///< of the canvas, lower left, in lattice spacings
  double outline_width = 0;     ///< lattice spacings
  double outline_strength = 0;  ///< 0 draws no outline, 1 the darkest one

  lattice::Rectangle view() const {
    return {corner.x(), corner.y(), corner.x() + width / samples_per_spacing,
            corner.y() + height / samples_per_spacing};
  }

  /// The samples whose centre lies in `rectangle`, the lower left one first.
  PixelBox samples_in(const lattice::Rectangle& rectangle) const {
    const auto first = [](double coordinate, int count) {
      return static_cast<int>(
          std::clamp(std::ceil(coordinate - 0.5), 0.0, static_cast<double>(count)));
    };
    const int left = first((rectangle.left - corner.x()) * samples_per_spacing, width);
    const int right = first((rectangle.right - corner.x()) * samples_per_spacing, width);
    const int bottom = first((rectangle.bottom - corner.y()) * samples_per_spacing, height);
    const int top = first((rectangle.top - corner.y()) * samples_per_spacing, height);
    return {left, bottom, std::max(0, right - left), std::max(0, top - bottom)};
  }
};

/// Projection from the plane to `samples` samples per pixel along each axis.
Projection projection_of(const lattice::Rectangle& view, const Layout& layout, int samples,
                         int picture_height);

}  // namespace clca::render
