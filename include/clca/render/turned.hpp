#pragma once
// Rotating pictures.

#include "clca/render/image.hpp"

namespace clca::render {

/// The picture rotated about its middle by `degrees`, anticlockwise, at the same size; `blank`
/// fills the corners. Bilinear interpolation.
Image turned(const Image& image, double degrees, Rgb blank);

}  // namespace clca::render
