#pragma once
// Boxes and hexagons drawn into a finished picture, in pixels from its upper left corner.

#include "clca/render/image.hpp"

namespace clca::render {

/// At least one pixel wide and high; what leaves the picture is cut off.
void fill_box(Image& image, double left, double top, double right, double bottom, Rgb color);

/// A hexagon with the form of particles, `radius` from its middle to its corners, and its outline.
void draw_hexagon(Image& image, double x, double y, double radius, double outline, Rgb color);

}  // namespace clca::render
