#pragma once
// Layout of view and annotations in a picture, and the part of the plane that the view shows.

#include "clca/lattice/region.hpp"
#include "clca/render/painter.hpp"
#include "render/projection.hpp"

namespace clca::render {

struct Layout {
  PixelBox panel;     ///< shows the view
  double scale = 1;   ///< pixels a lattice spacing
  int text_size = 0;  ///< pixels; 0: no annotations, or no room for them
  int text_left = 0;  ///< bounds of captions and legends
  int text_right = 0;
  bool captions = true;
  bool scale_bar = true;
};

struct PictureSize {
  int width = 0;  ///< pixels
  int height = 0;
};

/// A size in which the view fills the picture, with space for annotations if requested: even
/// numbers, an area of about 1280 x 720. What is given (not 0) is kept, the other follows.
PictureSize picture_size(int width, int height, const lattice::Rectangle& view,
                         Annotations annotations);

/// Fits `view` into a picture of width x height pixels, with space for annotations if requested.
Layout arrange(int width, int height, const lattice::Rectangle& view, Annotations annotations);

/// `style` with its view, or the whole box if it has none, and its size. Throws RenderError for an
/// invalid style.
Style completed(Style style, const lattice::Lattice& lattice);

/// Projection from the plane to `samples` samples per pixel along each axis.
Projection projection_of(const lattice::Rectangle& view, const Layout& layout, int samples,
                         int picture_height);

}  // namespace clca::render
