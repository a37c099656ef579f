#pragma once
// The picture that is drawn, and the position of its parts.

#include "clca/image/image.hpp"

namespace clca::render {

using image::Image;
using image::PixelBox;
using image::Rgb;

/// Where a picture shows the particles, and how large.
struct PictureView {
  PixelBox box;
  double pixels_per_spacing = 1;
};

}  // namespace clca::render
