#include "render/opengl/context.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

#include <array>
#include <cstdlib>
#include <functional>
#include <mutex>
#include <string_view>

#include "clca/render/painter.hpp"
#include "render/graphics.hpp"

#ifdef CLCA_OSMESA
#include <GL/osmesa.h>
#endif
#ifdef CLCA_EGL
#define EGL_NO_X11
#include <EGL/egl.h>
#include <EGL/eglext.h>
#endif

namespace clca::render {

namespace {

/// What makes contexts, to the end of the process. Loaded before the first of them: it brings
/// LLVM, which takes longer to load than many a run takes.
struct Library {
  std::function<void*()> create;
  std::function<void(void* context)> destroy;
  std::function<bool(void* context)> use;  ///< null: none
  std::function<GlContext::Function(const char* name)> address;
};

void* checked_pointer(void* place) {
  return place != nullptr ? place : throw RenderError(::dlerror());
}

void* shared_library(const char* name) {
  require_memory(std::size_t{384} << 20U);
  return checked_pointer(::dlopen(name, RTLD_NOW | RTLD_LOCAL));
}

template <class Function>
Function* function_of(void* library, const char* name) {
  return reinterpret_cast<Function*>(checked_pointer(::dlsym(library, name)));
}

#ifdef CLCA_OSMESA
Library osmesa() {
  void* const library = shared_library("libOSMesa.so.8");
  const auto create =
      function_of<decltype(OSMesaCreateContextExt)>(library, "OSMesaCreateContextExt");
  const auto destroy = function_of<decltype(OSMesaDestroyContext)>(library, "OSMesaDestroyContext");
  const auto use = function_of<decltype(OSMesaMakeCurrent)>(library, "OSMesaMakeCurrent");
  return {.create = [=] { return create(OSMESA_RGBA, 0, 0, 0, nullptr); },
          .destroy = [=](void* context) { destroy(static_cast<OSMesaContext>(context)); },
          .use =
              [=](void* context) {
                thread_local std::array<GLubyte, 4> pixel;  // wanted; drawing goes elsewhere
                return use(static_cast<OSMesaContext>(context), pixel.data(), GL_UNSIGNED_BYTE, 1,
                           1);
              },
          .address = function_of<decltype(OSMesaGetProcAddress)>(library, "OSMesaGetProcAddress")};
}
#endif

#ifdef CLCA_EGL
Library egl() {
  void* const library = shared_library("libEGL.so.1");
  const auto bind = function_of<decltype(eglBindAPI)>(library, "eglBindAPI");
  const auto create = function_of<decltype(eglCreateContext)>(library, "eglCreateContext");
  const auto destroy = function_of<decltype(eglDestroyContext)>(library, "eglDestroyContext");
  const auto use = function_of<decltype(eglMakeCurrent)>(library, "eglMakeCurrent");
  setenv("LIBGL_ALWAYS_SOFTWARE", "1", 0);  // about the same picture on any machine
  void* display = function_of<decltype(eglGetPlatformDisplay)>(library, "eglGetPlatformDisplay")(
      EGL_PLATFORM_SURFACELESS_MESA, nullptr, nullptr);
  const auto initialize = function_of<decltype(eglInitialize)>(library, "eglInitialize");
  if (initialize(display, nullptr, nullptr) == EGL_FALSE) {
    throw RenderError("EGL draws nothing without a surface");
  }
  return {.create =
              [=] {
                bind(EGL_OPENGL_API);
                return create(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, nullptr);
              },
          .destroy = [=](void* context) { destroy(display, context); },
          .use =
              [=](void* context) {
                bind(EGL_OPENGL_API);  // for this thread
                return use(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context);
              },
          .address = function_of<decltype(eglGetProcAddress)>(library, "eglGetProcAddress")};
}
#endif

Library first_library() {
  std::string problems;
  for (Library (*const load)() : {
#ifdef CLCA_OSMESA
           osmesa,
#endif
#ifdef CLCA_EGL
           egl,
#endif
       }) {
    try {
      return load();
    } catch (const RenderError& error) {
      problems += fmt::format("{}{}", problems.empty() ? "" : "; ", error.what());
    }
  }
  throw RenderError(fmt::format("nothing here draws polygons: {}", problems));
}

const Library& library() {
  static const Library kLibrary = first_library();
  return kLibrary;
}

void* new_context() {
  prepare_opengl();
  require_memory();
  void* context = library().create();
  if (context == nullptr) {
    throw RenderError("there is no OpenGL context");
  }
  return context;
}

}  // namespace

GlContext::GlContext() : handle_(new_context()) {}

GlContext::~GlContext() {
  library().destroy(handle_);
}

GlContext::Function GlContext::function(const char* name) {
  const Function found = library().address(name);
  return found != nullptr ? found : throw RenderError(fmt::format("OpenGL has no {}", name));
}

std::shared_ptr<void> GlContext::make_current() const {
  require_memory();
  if (!library().use(handle_)) {
    throw RenderError("the OpenGL context cannot be used");
  }
  return {handle_, [](void* /*context*/) { library().use(nullptr); }};
}

std::string environment_problem(const char* driver, const char* vector_width) {
  const std::string_view name = driver == nullptr ? "" : driver;
  if (!name.empty() && name != "llvmpipe" && name != "softpipe") {
    return fmt::format(
        "GALLIUM_DRIVER is \"{}\"; polygons are drawn with llvmpipe or softpipe: unset it", name);
  }
  const std::string_view width = vector_width == nullptr ? "128" : vector_width;
  if (width != "128" && width != "256") {
    return fmt::format("LP_NATIVE_VECTOR_WIDTH is \"{}\"; 128 and 256 work: unset it", width);
  }
  return {};
}

void prepare_opengl() {
  static std::mutex mutex;  // setenv races with itself
  const std::lock_guard lock(mutex);
  const std::string problem =
      environment_problem(std::getenv("GALLIUM_DRIVER"), std::getenv("LP_NATIVE_VECTOR_WIDTH"));
  if (!problem.empty()) {
    throw RenderError(problem);
  }
  setenv("LP_NUM_THREADS", "0", 0);
  library();
}

}  // namespace clca::render
