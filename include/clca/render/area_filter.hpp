#pragma once
// Resizing pictures.

#include "clca/render/image.hpp"

namespace clca::render {

/// The picture resized: each pixel is the rounded mean of the area it covers, in integers. Both
/// sizes are positive.
Image scaled(const Image& image, int width, int height);

}  // namespace clca::render
