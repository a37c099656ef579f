#pragma once
// Text drawn into a finished picture, unhinted: the same letters from every set-up of FreeType.

#include <memory>
#include <string>
#include <string_view>

#include "clca/render/image.hpp"

namespace clca::render {

class Font {
 public:
  /// DejaVu Sans. Throws RenderError if it is missing.
  Font();
  ~Font();
  Font(const Font&) = delete;
  Font& operator=(const Font&) = delete;
  Font(Font&&) noexcept;
  Font& operator=(Font&&) noexcept;

  /// Approximate line spacing in pixels.
  void set_size(double pixels);
  /// Width of `text` (UTF-8, one line) in pixels.
  double width(std::string_view text) const;
  /// Draws `text` starting at (x, baseline); clipped to the picture.
  void draw(Image& image, double x, double baseline, std::string_view text, Rgb color) const;
  /// `text` shortened with an ellipsis to at most `room` pixels; empty if nothing fits.
  std::string shortened(std::string_view text, double room) const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace clca::render
