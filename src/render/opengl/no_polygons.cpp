// For a build without OpenGL.

#include "clca/render/painter.hpp"
#include "render/opengl/polygons.hpp"

namespace clca::render {

PolygonPainter polygon_painter(const Projection& /*projection*/, int /*samples*/,
                               const PixelBox& /*box*/, std::span<const grains::Kind> /*kinds*/) {
  prepare_opengl();
  return {};
}

void prepare_opengl() {
  throw RenderError("this build draws no polygons: it was made without OSMesa and EGL");
}

}  // namespace clca::render
