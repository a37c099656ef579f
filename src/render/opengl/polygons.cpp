#include "render/opengl/polygons.hpp"

#define GL_GLEXT_PROTOTYPES  // types of functions; no library is linked
#include <GL/gl.h>
#include <GL/glext.h>
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>

#include "clca/render/painter.hpp"
#include "render/colors.hpp"
#include "render/opengl/context.hpp"

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

/// The OpenGL functions of the current context, whose objects live as long as it does.
struct Gl {
// NOLINTBEGIN(bugprone-macro-parentheses): a name that is declared has none
#define CLCA_GL(name) \
  decltype(&gl##name) name = reinterpret_cast<decltype(name)>(GlContext::function("gl" #name));
  // NOLINTEND(bugprone-macro-parentheses)
  CLCA_GL_FUNCTIONS(CLCA_GL)
#undef CLCA_GL
};

struct Vertex {
  float x = 0;  // in clip space
  float y = 0;
  std::uint8_t red = 0, green = 0, blue = 0, alpha = 255;
};

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
    const auto current = context_.make_current();
    gl_.emplace();
    add_framebuffer();
    gl_->Viewport(0, 0, projection.width, projection.height);
    gl_->Scissor(box.x, box.y, box.width, box.height);
    gl_->EnableClientState(GL_VERTEX_ARRAY);
    gl_->EnableClientState(GL_COLOR_ARRAY);
    check();
  }

  std::vector<Sample> drawn(std::span<const Body> bodies) const {
    constexpr std::size_t kMaxVertices = std::size_t{3} << 16U;  // at a time: 2.4 MB
    const auto current = context_.make_current();
    gl_->Disable(GL_SCISSOR_TEST);
    gl_->Clear(GL_COLOR_BUFFER_BIT);
    gl_->Enable(GL_SCISSOR_TEST);
    std::vector<Vertex> vertices;
    for (const Body& body : bodies) {
      add(body, vertices);
      if (vertices.size() > kMaxVertices || &body == &bodies.back()) {
        gl_->VertexPointer(2, GL_FLOAT, sizeof(Vertex), &vertices.front().x);
        gl_->ColorPointer(4, GL_UNSIGNED_BYTE, sizeof(Vertex), &vertices.front().red);
        gl_->DrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(vertices.size()));
        vertices.clear();
      }
    }
    std::vector<Sample> samples(static_cast<std::size_t>(projection_.width) *
                                static_cast<std::size_t>(projection_.height));
    gl_->ReadPixels(0, 0, projection_.width, projection_.height, GL_BGRA,
                    GL_UNSIGNED_INT_8_8_8_8_REV, samples.data());
    check();
    return samples;
  }

 private:
  void add_framebuffer() const {
    GLint limit = 0;
    gl_->GetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &limit);
    if (std::max(projection_.width, projection_.height) > limit) {
      throw RenderError(fmt::format(
          "polygons in {} x {} pixels with supersampling {} are too large: {} samples at most",
          projection_.width / samples_, projection_.height / samples_, samples_, limit));
    }
    GLuint framebuffer = 0;
    GLuint renderbuffer = 0;
    gl_->GenFramebuffers(1, &framebuffer);
    gl_->GenRenderbuffers(1, &renderbuffer);
    gl_->BindRenderbuffer(GL_RENDERBUFFER, renderbuffer);
    gl_->RenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, projection_.width, projection_.height);
    gl_->BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    gl_->FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER,
                                 renderbuffer);
    check();
    if (gl_->CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
      throw RenderError("the OpenGL driver cannot draw off screen");
    }
  }

  void check() const {
    const GLenum error = gl_->GetError();
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
      const Eigen::Vector2d place = position_from_halves(body.place + corner.point) +
                                    projection_.outline_width * corner.inward;
      const Eigen::Array2d sample =
          projection_.samples_per_spacing * (place - projection_.corner).array();
      const Eigen::Array2f clip = (2 * sample / size - 1).cast<float>();
      const Rgb color = corner.outlined ? outline : body.fill;
      vertices.push_back({clip.x(), clip.y(), color.red, color.green, color.blue});
    }
  }

  Projection projection_;
  int samples_;
  std::vector<Triangles> triangles_;  // by kind
  GlContext context_;
  std::optional<Gl> gl_;
};

}  // namespace

PolygonPainter polygon_painter(const Projection& projection, int samples, const PixelBox& box,
                               std::span<const grains::Kind> kinds) {
  return [canvas = std::make_shared<const Canvas>(projection, samples, box, kinds)](
             std::span<const Body> bodies) { return canvas->drawn(bodies); };
}

}  // namespace clca::render
