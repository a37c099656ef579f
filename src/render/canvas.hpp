#pragma once
// An off-screen picture with several samples a pixel.

#include <cstdint>
#include <span>
#include <vector>

#include "render/context.hpp"
#include "render/gl.hpp"

namespace clca::render {

class Canvas {
 public:
  /// `width` x `height` pixels of samples x samples each. Throws RenderError when that is more
  /// than the driver can draw.
  Canvas(int width, int height, int samples);

  /// Makes the canvas the current target of this thread.
  class Session {
   public:
    explicit Session(Canvas& canvas);

   private:
    Context::Current current_;
  };

  const Gl& gl() const { return gl_; }

  /// Throws RenderError when a picture of this size is more than the driver can draw.
  void require_size(int width, int height, int samples) const;
  /// RGBA of all samples, row by row from the lower left. Valid until the next call.
  std::span<const std::uint8_t> read();

 private:
  void add_target();

  int width_;
  int height_;
  int samples_;
  Context context_;
  Gl gl_;
  GLuint framebuffer_ = 0;
  std::vector<std::uint8_t> rgba_;
};

}  // namespace clca::render
