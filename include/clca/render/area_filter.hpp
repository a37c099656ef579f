#pragma once
// Pictures in another size.

#include "clca/render/image.hpp"

namespace clca::render {

/// Each pixel is the mean of the part of `image` that it covers, rounded: in whole numbers, the
/// same everywhere. Both sizes are positive.
Image scaled(const Image& image, int width, int height);

}  // namespace clca::render
