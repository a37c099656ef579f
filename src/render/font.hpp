#pragma once
// Text drawn into a finished picture, unhinted: the same letters from every set-up of FreeType.

#include <memory>
#include <string>
#include <string_view>

#include "clca/render/image.hpp"

namespace clca::render {

class Font {
 public:
  /// DejaVu Sans. Throws RenderError when it is not there.
  Font();
  ~Font();
  Font(const Font&) = delete;
  Font& operator=(const Font&) = delete;
  Font(Font&&) noexcept;
  Font& operator=(Font&&) noexcept;

  /// Pixels from line to line, about.
  void set_size(double pixels);
  /// Pixels that `text` (UTF-8, one line) takes up.
  double width(std::string_view text) const;
  /// Draws `text` from (x, baseline) to the right; what leaves the picture is cut off.
  void draw(Image& image, double x, double baseline, std::string_view text, Rgb color) const;
  /// `text`, or its beginning and an ellipsis, or nothing: no wider than `room` pixels.
  std::string shortened(std::string_view text, double room) const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace clca::render
