#include "render/opengl/polygons.hpp"

#define EGL_NO_X11
#define GL_GLEXT_PROTOTYPES  // types of functions; no library is linked
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GL/gl.h>
#include <GL/glext.h>
#include <dlfcn.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <mutex>
#include <string_view>

#include "clca/render/painter.hpp"
#include "render/colors.hpp"
#include "render/graphics.hpp"

// The OpenGL functions used here, without "gl".
// clang-format off
#define CLCA_GL_FUNCTIONS(X)                                                                \
  X(BindFramebuffer) X(BindRenderbuffer) X(CheckFramebufferStatus) X(Clear) X(ColorPointer) \
  X(Disable) X(DrawArrays) X(Enable) X(EnableClientState) X(FramebufferRenderbuffer)        \
  X(GenFramebuffers) X(GenRenderbuffers) X(GetError) X(GetIntegerv) X(ReadPixels)           \
  X(RenderbufferStorage) X(Scissor) X(VertexPointer) X(Viewport)
// clang-format on

namespace clca::render {

namespace {

using lattice::Axial;
using Address = decltype(eglGetProcAddress);

/// Loaded to the end of the process.
struct Library {
  Address* address = nullptr;
};

Library libegl() {
  require_memory(std::size_t{384} << 20U);
  void* const library = ::dlopen("libEGL.so.1", RTLD_NOW | RTLD_LOCAL);
  void* const address = library == nullptr ? nullptr : ::dlsym(library, "eglGetProcAddress");
  if (address == nullptr) {
    throw RenderError(fmt::format("nothing here draws polygons: {}", ::dlerror()));
  }
  return {reinterpret_cast<Address*>(address)};
}

/// A function of EGL or OpenGL. Throws RenderError when there is none of that name.
template <class Function>
Function* function(const char* name) {
  static const Library kLibrary = libegl();
  const auto found = kLibrary.address(name);
  return found != nullptr ? reinterpret_cast<Function*>(found)
                          : throw RenderError(fmt::format("OpenGL has no {}", name));
}

/// EGL without a surface, to the end of the process. Loaded before the first context: it brings
/// LLVM, which takes longer to load than many a run takes.
struct Egl {
  decltype(eglBindAPI)* bind = function<decltype(eglBindAPI)>("eglBindAPI");
  decltype(eglCreateContext)* create = function<decltype(eglCreateContext)>("eglCreateContext");
  decltype(eglDestroyContext)* destroy = function<decltype(eglDestroyContext)>("eglDestroyContext");
  decltype(eglMakeCurrent)* use = function<decltype(eglMakeCurrent)>("eglMakeCurrent");
  EGLDisplay display = function<decltype(eglGetPlatformDisplay)>("eglGetPlatformDisplay")(
      EGL_PLATFORM_SURFACELESS_MESA, nullptr, nullptr);

  Egl() {
    if (function<decltype(eglInitialize)>("eglInitialize")(display, nullptr, nullptr) ==
        EGL_FALSE) {
      throw RenderError("nothing here draws polygons: EGL draws nothing without a surface");
    }
  }

  static const Egl& get() {
    static const Egl kEgl;
    return kEgl;
  }
};

/// Throws RenderError, std::bad_alloc.
std::shared_ptr<void> new_context() {
  prepare_polygons();
  require_memory();
  const Egl& egl = Egl::get();
  egl.bind(EGL_OPENGL_API);
  void* const context = egl.create(egl.display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, nullptr);
  if (context == nullptr) {
    throw RenderError("there is no OpenGL context");
  }
  return {context, [&egl](void* made) { egl.destroy(egl.display, made); }};
}

/// Makes it current for this thread, as long as there is what is returned.
std::shared_ptr<void> current(void* context) {
  require_memory();
  const auto use = [](void* wanted) {
    const Egl& egl = Egl::get();
    egl.bind(EGL_OPENGL_API);  // for this thread
    return egl.use(egl.display, EGL_NO_SURFACE, EGL_NO_SURFACE, wanted) != EGL_FALSE;
  };
  if (!use(context)) {
    throw RenderError("the OpenGL context cannot be used");
  }
  return {context, [use](void* /*context*/) { use(nullptr); }};
}

/// Objects of OpenGL live as long as their context.
struct Gl {
// NOLINTBEGIN(bugprone-macro-parentheses): a name that is declared has none
#define CLCA_GL(name) decltype(&gl##name) name = function<decltype(gl##name)>("gl" #name);
  // NOLINTEND(bugprone-macro-parentheses)
  CLCA_GL_FUNCTIONS(CLCA_GL)
#undef CLCA_GL
};

struct Vertex {
  float x = 0;  // in clip space
  float y = 0;
  std::uint8_t red = 0, green = 0, blue = 0, alpha = 255;
};

/// A corner of a triangle.
struct Corner {
  Axial point;                                      ///< from the reference site
  Eigen::Vector2d inward{Eigen::Vector2d::Zero()};  ///< in widths of the outline
  bool outlined = false;
};
using Triangles = std::vector<Corner>;  ///< three corners each

void add_fill(Triangles& triangles, const lattice::Shape& shape) {
  for (const Trapezoid& piece : trapezoids(shape)) {
    for (const Axial point : {piece.left_low, piece.right_low, piece.right_high, piece.left_low,
                              piece.right_high, piece.left_high}) {
      triangles.push_back({.point = point});
    }
  }
}

Eigen::Vector2d inward_normal(Axial from, Axial to) {
  const Eigen::Vector2d along = (position(to) - position(from)).normalized();
  return {-along.y(), along.x()};
}

void add_line(Triangles& triangles, const Outline& outline) {
  const std::size_t count = outline.size();
  std::vector<Corner> inner;
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector2d before = inward_normal(outline[(i + count - 1) % count], outline[i]);
    const Eigen::Vector2d after = inward_normal(outline[i], outline[(i + 1) % count]);
    inner.push_back({outline[i], (before + after) / (1 + before.dot(after)), true});
  }
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t next = (i + 1) % count;
    const Corner here = {.point = outline[i], .outlined = true};
    const Corner there = {.point = outline[next], .outlined = true};
    triangles.insert(triangles.end(), {here, there, inner[next], here, inner[next], inner[i]});
  }
}

class Canvas {
 public:
  Canvas(const Projection& projection, int samples, const PixelBox& box,
         std::span<const grains::Kind> kinds)
      : projection_(projection), samples_(samples), triangles_(kinds.size()) {
    for (std::size_t kind = 0; kind < kinds.size(); ++kind) {
      add_fill(triangles_[kind], kinds[kind].shape);
      if (projection.outline_strength > 0) {
        add_line(triangles_[kind], outline(kinds[kind].shape));
      }
    }
    const auto drawing = current(context_.get());
    add_target();
    gl_.Viewport(0, 0, projection.width, projection.height);
    gl_.Scissor(box.x, box.y, box.width, box.height);
    gl_.EnableClientState(GL_VERTEX_ARRAY);
    gl_.EnableClientState(GL_COLOR_ARRAY);
    check();
  }

  std::vector<Sample> drawn(std::span<const Body> bodies) const {
    constexpr std::size_t kMaxVertices = std::size_t{3} << 16U;  // at a time: 2.4 MB
    const auto drawing = current(context_.get());
    gl_.Disable(GL_SCISSOR_TEST);
    gl_.Clear(GL_COLOR_BUFFER_BIT);
    gl_.Enable(GL_SCISSOR_TEST);
    std::vector<Vertex> vertices;
    for (const Body& body : bodies) {
      add(body, vertices);
      if (vertices.size() > kMaxVertices || &body == &bodies.back()) {
        gl_.VertexPointer(2, GL_FLOAT, sizeof(Vertex), &vertices.front().x);
        gl_.ColorPointer(4, GL_UNSIGNED_BYTE, sizeof(Vertex), &vertices.front().red);
        gl_.DrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(vertices.size()));
        vertices.clear();
      }
    }
    std::vector<Sample> samples(static_cast<std::size_t>(projection_.width) *
                                static_cast<std::size_t>(projection_.height));
    gl_.ReadPixels(0, 0, projection_.width, projection_.height, GL_BGRA,
                   GL_UNSIGNED_INT_8_8_8_8_REV, samples.data());
    check();
    return samples;
  }

 private:
  void add_target() const {
    GLint limit = 0;
    gl_.GetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &limit);
    if (std::max(projection_.width, projection_.height) > limit) {
      throw RenderError(fmt::format(
          "polygons in {} x {} pixels with supersampling {} are too large: {} samples at most",
          projection_.width / samples_, projection_.height / samples_, samples_, limit));
    }
    GLuint framebuffer = 0;
    GLuint renderbuffer = 0;
    gl_.GenFramebuffers(1, &framebuffer);
    gl_.GenRenderbuffers(1, &renderbuffer);
    gl_.BindRenderbuffer(GL_RENDERBUFFER, renderbuffer);
    gl_.RenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, projection_.width, projection_.height);
    gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    gl_.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER,
                                renderbuffer);
    check();
    if (gl_.CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
      throw RenderError("the OpenGL driver cannot draw off screen");
    }
  }

  void check() const {
    const GLenum error = gl_.GetError();
    if (error != GL_NO_ERROR) {
      throw RenderError(error == GL_OUT_OF_MEMORY ? "no memory to draw polygons"
                                                  : fmt::format("OpenGL error {:#06x}", error));
    }
  }

  void add(const Body& body, std::vector<Vertex>& vertices) const {
    const Eigen::Array2d size(projection_.width, projection_.height);
    const Rgb outline = outline_color(body.fill, projection_.outline_strength);
    for (const Corner& corner : triangles_[body.kind]) {
      // Exact whole numbers, so bodies that share a corner agree on it to the last bit.
      const Eigen::Vector2d place = lattice::position(body.place + corner.point) / 2 +
                                    projection_.outline_width * corner.inward;
      const Eigen::Array2d sample = projection_.scale * (place - projection_.corner).array();
      const Eigen::Array2f clip = (2 * sample / size - 1).cast<float>();
      const Rgb color = corner.outlined ? outline : body.fill;
      vertices.push_back({clip.x(), clip.y(), color.red, color.green, color.blue});
    }
  }

  Projection projection_;
  int samples_;
  std::vector<Triangles> triangles_;  // by kind
  std::shared_ptr<void> context_ = new_context();
  Gl gl_;
};

}  // namespace

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

void prepare_polygons() {
  static std::mutex mutex;  // setenv races with itself
  const std::lock_guard lock(mutex);
  const std::string problem =
      environment_problem(std::getenv("GALLIUM_DRIVER"), std::getenv("LP_NATIVE_VECTOR_WIDTH"));
  if (!problem.empty()) {
    throw RenderError(problem);
  }
  setenv("LP_NUM_THREADS", "0", 0);
  setenv("LIBGL_ALWAYS_SOFTWARE", "1", 0);  // about the same picture on any machine
  Egl::get();
}

PolygonPainter polygon_painter(const Projection& projection, int samples, const PixelBox& box,
                               std::span<const grains::Kind> kinds) {
  return [canvas = std::make_shared<const Canvas>(projection, samples, box, kinds)](
             std::span<const Body> bodies) { return canvas->drawn(bodies); };
}

}  // namespace clca::render
