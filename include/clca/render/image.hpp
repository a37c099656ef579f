#pragma once
// The picture that is drawn, and where it has what.

#include "clca/image/image.hpp"

namespace clca::render {

using image::Image;
using image::PixelBox;
using image::Rgb;

/// Where a picture shows the particles, and how large.
struct PictureView {
  PixelBox box;
  double scale = 1;  ///< pixels a lattice spacing
};

}  // namespace clca::render
