#pragma once
// The picture that is drawn, and where it has what.

#include "clca/image/image.hpp"

namespace clca::render {

using image::Image;
using image::PixelBox;
using image::Rgb;

/// Where a picture has its parts. Those that it has not are of width 0.
struct PictureParts {
  PixelBox view;
  PixelBox legend = {};
  PixelBox scale_bar = {};  ///< in the box of the legend
};

}  // namespace clca::render
