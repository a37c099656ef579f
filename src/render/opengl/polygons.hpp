#pragma once
// Draws particles as polygons, by OpenGL.

#include <functional>
#include <span>
#include <vector>

#include "clca/grains/state.hpp"
#include "render/layout.hpp"
#include "render/samples.hpp"

namespace clca::render {

/// Draws bodies, the last one on top: samples row by row from the lower left, 0 without a body and
/// with bits above the colour where there is one.
using PolygonPainter = std::function<std::vector<Sample>(std::span<const Body> bodies)>;

/// For pictures of `samples` x `samples` samples a pixel, with particles in `box` only, whose
/// lower left sample comes first. Throws RenderError.
PolygonPainter polygon_painter(const Projection& projection, int samples, const PixelBox& box,
                               std::span<const grains::Kind> kinds);

}  // namespace clca::render
