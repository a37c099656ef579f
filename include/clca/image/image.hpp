#pragma once
// A picture in memory.

#include <cstddef>
#include <cstdint>
#include <vector>

namespace clca::image {

struct Rgb {
  std::uint8_t red = 0;
  std::uint8_t green = 0;
  std::uint8_t blue = 0;

  bool operator==(const Rgb&) const = default;
};

/// A rectangle of pixels from the upper left one or, where said, of samples from the lower left
/// one.
struct PixelBox {
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;

  bool operator==(const PixelBox&) const = default;
};

/// Pixels by rows from the top left, `width * height` of them.
struct Image {
  int width = 0;
  int height = 0;
  std::vector<Rgb> pixels;

  Image() = default;
  Image(int image_width, int image_height, Rgb fill)
      : width(image_width),
        height(image_height),
        pixels(static_cast<std::size_t>(image_width) * static_cast<std::size_t>(image_height),
               fill) {}

  Rgb& at(int x, int y) {
    return pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(x)];
  }
  Rgb at(int x, int y) const { return const_cast<Image&>(*this).at(x, y); }
  bool operator==(const Image&) const = default;
};

}  // namespace clca::image
