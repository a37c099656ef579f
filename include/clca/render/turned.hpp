#pragma once
// Pictures turned.

#include "clca/render/image.hpp"

namespace clca::render {

/// The picture turned about its middle by `degrees`, anticlockwise, in a frame of the same size;
/// what comes from outside of it is `blank`. Between pixels by the four around.
Image turned(const Image& image, double degrees, Rgb blank);

}  // namespace clca::render
