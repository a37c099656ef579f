#include "render/canvas.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "clca/render/painter.hpp"

namespace clca::render {

namespace {

Gl loaded(Context& context) {
  const Context::Current current(context);
  return {};
}

}  // namespace

Canvas::Canvas(int width, int height, int samples)
    : width_(width), height_(height), samples_(samples), gl_(loaded(context_)) {
  const Context::Current current(context_);
  require_size(width, height, samples);
  add_target();
  gl_.Disable(GL_BLEND);
  gl_.Disable(GL_DITHER);
}

void Canvas::require_size(int width, int height, int samples) const {
  std::array<GLint, 2> viewport = {};
  gl_.GetIntegerv(GL_MAX_VIEWPORT_DIMS, viewport.data());
  const GLint limit = std::min({gl_.integer(GL_MAX_RENDERBUFFER_SIZE),
                                gl_.integer(GL_MAX_TEXTURE_SIZE), viewport[0], viewport[1]});
  if (static_cast<std::int64_t>(std::max(width, height)) * samples > limit) {
    throw RenderError(fmt::format(
        "a picture of {} x {} pixels with supersampling {} is too large: width and height times "
        "supersampling may be {} at most",
        width, height, samples, limit));
  }
}

void Canvas::add_target() {
  GLuint renderbuffer = 0;
  gl_.GenFramebuffers(1, &framebuffer_);
  gl_.GenRenderbuffers(1, &renderbuffer);
  gl_.BindRenderbuffer(GL_RENDERBUFFER, renderbuffer);
  gl_.RenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, width_ * samples_, height_ * samples_);
  gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  gl_.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, renderbuffer);
  gl_.check("a picture");
  if (gl_.CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
    throw RenderError("the OpenGL driver cannot draw off screen");
  }
}

Canvas::Session::Session(Canvas& canvas) : current_(canvas.context_) {
  canvas.gl_.BindFramebuffer(GL_FRAMEBUFFER, canvas.framebuffer_);
  canvas.gl_.Viewport(0, 0, canvas.width_ * canvas.samples_, canvas.height_ * canvas.samples_);
}

std::span<const std::uint8_t> Canvas::read() {
  const int width = width_ * samples_;
  const int height = height_ * samples_;
  rgba_.resize(std::size_t{4} * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  gl_.ReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, rgba_.data());
  gl_.check("drawing");
  return rgba_;
}

}  // namespace clca::render
