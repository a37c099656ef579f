#include "render/context.hpp"

#include <GL/osmesa.h>

#include "clca/render/painter.hpp"
#include "render/environment.hpp"

namespace clca::render {

namespace {

OSMesaContext create() {
  prepare_environment();
  require_memory();
  constexpr std::array<int, 13> kAttributes = {OSMESA_FORMAT,
                                               OSMESA_RGBA,
                                               OSMESA_DEPTH_BITS,
                                               0,
                                               OSMESA_STENCIL_BITS,
                                               0,
                                               OSMESA_PROFILE,
                                               OSMESA_CORE_PROFILE,
                                               OSMESA_CONTEXT_MAJOR_VERSION,
                                               3,
                                               OSMESA_CONTEXT_MINOR_VERSION,
                                               3,
                                               0};
  return OSMesaCreateContextAttribs(kAttributes.data(), nullptr);
}

}  // namespace

Context::Context() : handle_(create()) {
  if (handle_ == nullptr) {
    throw RenderError("OSMesa gives no OpenGL 3.3 core context");
  }
}

Context::~Context() {
  OSMesaDestroyContext(static_cast<OSMesaContext>(handle_));
}

Context::Function Context::function(const char* name) {
  return OSMesaGetProcAddress(name);
}

Context::Current::Current(Context& context) {
  require_memory();
  if (OSMesaMakeCurrent(static_cast<OSMesaContext>(context.handle_), context.pixel_.data(),
                        GL_UNSIGNED_BYTE, 1, 1) == GL_FALSE) {
    throw RenderError("OSMesa cannot use its OpenGL context");
  }
}

Context::Current::~Current() {
  OSMesaMakeCurrent(nullptr, nullptr, GL_UNSIGNED_BYTE, 0, 0);
}

}  // namespace clca::render
