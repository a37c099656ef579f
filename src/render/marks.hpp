#pragma once
// Boxes and hexagons drawn into a finished picture, in pixels from its upper left corner.

#include "clca/render/image.hpp"

namespace clca::render {

/// At least one pixel wide and high; clipped to the picture.
void fill_box(Image& image, double left, double top, double right, double bottom, Rgb color);

/// A hexagon like that of particles, with outline; `radius` is the circumradius.
void draw_hexagon(Image& image, double x, double y, double radius, double outline, Rgb color);

}  // namespace clca::render
