#pragma once
// Draws particles as polygons, by OpenGL: of OSMesa or, where there is none, of EGL without a
// surface.

#include <functional>
#include <span>
#include <string>
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

/// The problem with these values of GALLIUM_DRIVER and LP_NATIVE_VECTOR_WIDTH (null: unset), if
/// any. Mesa crashes on unknown values, so they are checked first.
std::string environment_problem(const char* driver, const char* vector_width);

}  // namespace clca::render
