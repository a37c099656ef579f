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

/// Adds up `samples` rows of `width` pixels, each `samples` samples of four bytes wide.
void add_rows(const std::uint8_t* rgba, int width, int samples, std::vector<std::uint32_t>& sums) {
  std::fill(sums.begin(), sums.end(), 0U);
  for (int row = 0; row < samples; ++row) {
    for (std::size_t x = 0; x < static_cast<std::size_t>(width); ++x) {
      for (int sample = 0; sample < samples; ++sample, rgba += 4) {
        sums[3 * x] += rgba[0];
        sums[3 * x + 1] += rgba[1];
        sums[3 * x + 2] += rgba[2];
      }
    }
  }
}

}  // namespace

Canvas::Canvas(int width, int height, int samples)
    : width_(width), height_(height), samples_(samples), gl_(loaded(context_)) {
  const Context::Current current(context_);
  require_size(width, height, samples);
  drawing_ = target();
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

Canvas::Target Canvas::target() const {
  Target result;
  gl_.GenFramebuffers(1, &result.framebuffer);
  gl_.GenRenderbuffers(1, &result.renderbuffer);
  gl_.BindRenderbuffer(GL_RENDERBUFFER, result.renderbuffer);
  gl_.RenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, width_ * samples_, height_ * samples_);
  gl_.BindFramebuffer(GL_FRAMEBUFFER, result.framebuffer);
  gl_.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER,
                              result.renderbuffer);
  gl_.check("a picture");
  if (gl_.CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
    throw RenderError("the OpenGL driver cannot draw off screen");
  }
  return result;
}

Canvas::Session::Session(Canvas& canvas) : current_(canvas.context_) {
  canvas.gl_.BindFramebuffer(GL_FRAMEBUFFER, canvas.drawing_.framebuffer);
  canvas.gl_.Viewport(0, 0, canvas.width_ * canvas.samples_, canvas.height_ * canvas.samples_);
}

void Canvas::copy(const Target& from, const Target& to) const {
  const GLint width = width_ * samples_;
  const GLint height = height_ * samples_;
  gl_.Disable(GL_SCISSOR_TEST);
  gl_.BindFramebuffer(GL_READ_FRAMEBUFFER, from.framebuffer);
  gl_.BindFramebuffer(GL_DRAW_FRAMEBUFFER, to.framebuffer);
  gl_.BlitFramebuffer(0, 0, width, height, 0, 0, width, height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
  gl_.BindFramebuffer(GL_FRAMEBUFFER, drawing_.framebuffer);
}

void Canvas::keep_backdrop() {
  if (backdrop_.framebuffer == 0) {
    backdrop_ = target();
  }
  copy(drawing_, backdrop_);
}

void Canvas::restore_backdrop() {
  copy(backdrop_, drawing_);
}

Image Canvas::read() {
  const auto width = static_cast<std::size_t>(width_);
  const auto samples = static_cast<std::size_t>(samples_);
  const std::size_t row_bytes = 4 * width * samples * samples;  // of one row of pixels
  rgba_.resize(row_bytes * static_cast<std::size_t>(height_));
  gl_.ReadPixels(0, 0, width_ * samples_, height_ * samples_, GL_RGBA, GL_UNSIGNED_BYTE,
                 rgba_.data());
  gl_.check("drawing");
  Image image(width_, height_, Rgb{});
  std::vector<std::uint32_t> sums(3 * width);
  const auto count = static_cast<std::uint32_t>(samples_ * samples_);
  const auto mean = [count](std::uint32_t sum) {
    return static_cast<std::uint8_t>((sum + count / 2) / count);
  };
  for (int y = 0; y < height_; ++y) {
    add_rows(rgba_.data() + row_bytes * static_cast<std::size_t>(height_ - 1 - y), width_, samples_,
             sums);
    for (std::size_t x = 0; x < width; ++x) {
      image.pixels[static_cast<std::size_t>(y) * width + x] = {
          mean(sums[3 * x]), mean(sums[3 * x + 1]), mean(sums[3 * x + 2])};
    }
  }
  return image;
}

}  // namespace clca::render
