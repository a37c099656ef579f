#pragma once
// An off-screen picture with several samples a pixel.

#include <vector>

#include "clca/render/image.hpp"
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
  /// Keeps a copy of what is drawn now, to start later pictures from.
  void keep_backdrop();
  void restore_backdrop();
  /// Mean colour of the samples of each pixel.
  Image read();

 private:
  struct Target {
    GLuint framebuffer = 0;
    GLuint renderbuffer = 0;
  };
  Target target() const;
  void copy(const Target& from, const Target& to) const;

  int width_;
  int height_;
  int samples_;
  Context context_;
  Gl gl_;
  Target drawing_;
  Target backdrop_;
  std::vector<std::uint8_t> rgba_;
};

}  // namespace clca::render
