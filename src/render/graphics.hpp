#pragma once
// Shapes, pictures and text drawn on a picture, by Cairo and Pango. Lengths in pixels from the
// upper left corner.

#include <Eigen/Core>
#include <functional>
#include <limits>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "clca/render/image.hpp"
#include "clca/render/overlays.hpp"
#include "clca/render/painter.hpp"

// Of Cairo, whose header only graphics.cpp includes.
struct _cairo;  // NOLINT(bugprone-reserved-identifier)

namespace clca::render {

/// Throws std::bad_alloc unless so much address space is free: OSMesa, GLib and fontconfig end
/// the program where they get no memory.
void require_memory(std::size_t bytes = std::size_t{128} << 20U);

class Graphics {
 public:
  /// What is drawn on: pixels, or vector graphics with pixels of 1/96 inch. White at first.
  enum class Medium : std::uint8_t { picture, page };
  /// Throws RenderError if Cairo cannot draw a picture or page of this size, std::bad_alloc.
  Graphics(int width, int height, Medium medium = Medium::picture);

  /// The drawn picture; the rows of `without` are white.
  Image image(const PixelBox& without = {}) const;
  /// The PDF with the page, and a title for viewers. Nothing can be drawn afterwards.
  std::vector<std::uint8_t> pdf(const std::string& title);

  void fill_box(double left, double top, double right, double bottom, Rgb color);
  /// A box with colours from left to right, at equal distances.
  void fill_gradient(double left, double top, double right, double bottom,
                     std::span<const Rgb> colors);
  /// A closed polygon with an outline `line` wide inside its rim.
  void fill_polygon(std::span<const Eigen::Vector2d> corners, Rgb fill, double line, Rgb outline);
  /// Strokes that are not finite, or end further than a million pixels away, are left out.
  void draw_stroke(const Stroke& stroke);
  void fade(double share);  ///< fades everything to white by this share, from 0 to 1
  /// A picture in this box, resized where needed; downwards each pixel is a mean.
  void draw_image(const Image& image, double left, double top, double width, double height);

  class Text {
   public:
    double width() const { return width_; }

   private:
    friend Graphics;
    std::shared_ptr<void> layout_;  ///< PangoLayout; none of empty text
    double width_ = 0;
  };
  /// `text` (UTF-8) in letters of `size` pixels, shortened with an ellipsis to at most `room`;
  /// empty if nothing fits. Control characters become spaces.
  Text text(std::string_view text, double size,
            double room = std::numeric_limits<double>::infinity());
  void draw_text(const Text& text, double left, double baseline, Rgb color);

  /// Calls `draw`; what that draws is clipped to a box.
  void draw_clipped(double left, double top, double width, double height,
                    const std::function<void()>& draw);
  /// Up to the end of draw_clipped(): the upper left corner of the box is the origin, and all that
  /// is drawn is turned anticlockwise by `turn` degrees about its middle.
  void move_into(const PixelBox& box, double turn);

 private:
  void set_color(Rgb color);

  std::vector<std::uint8_t> pdf_;  ///< so far
  int width_;
  int height_;
  std::shared_ptr<_cairo> cairo_;
  // From the first text on.
  std::unique_lock<std::recursive_mutex> fonts_lock_;
  std::shared_ptr<void> fonts_;  ///< PangoContext
};

Image resized(const Image& image, int width, int height);

/// Puts `image` onto `picture`, with its upper left corner at `left`, `top`.
void paste(const Image& image, Image& picture, int left, int top);

/// The part of `image` in `box`, which lies in it.
Image cropped(const Image& image, const PixelBox& box);

}  // namespace clca::render
