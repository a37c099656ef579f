#pragma once
// Layout of view and annotations in a picture.

#include "clca/lattice/region.hpp"

namespace clca::render {

/// A rectangle of pixels, the upper left one first.
struct PixelBox {
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;
};

struct Layout {
  PixelBox panel;     ///< shows the view
  double scale = 1;   ///< pixels a lattice spacing
  int text_size = 0;  ///< pixels; 0: no annotations, or no room for them
  int text_left = 0;  ///< bounds of captions and legends
  int text_right = 0;
};

/// Fits `view` into a picture of width x height pixels, with space for annotations if requested.
Layout arrange(int width, int height, const lattice::Rectangle& view, bool annotations);

}  // namespace clca::render
