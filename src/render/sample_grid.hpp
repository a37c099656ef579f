#pragma once
// The content of each sample of a picture, before colouring.

#include <algorithm>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "clca/render/image.hpp"

namespace clca::render {

/// Content of a sample without a particle.
enum class Background : std::uint8_t { paper, wall, moving_wall };
inline constexpr std::size_t kBackgrounds = 3;

using SampleCode = std::uint16_t;

constexpr SampleCode code_of(Background ground) {
  return static_cast<SampleCode>(ground);
}
/// Code of a particle or its outline.
constexpr SampleCode code_of(std::size_t shade, bool outlined) {
  return static_cast<SampleCode>(kBackgrounds + 2 * shade + (outlined ? 1 : 0));
}

/// Samples column by column from the lower left, upwards.
class SampleGrid {
 public:
  SampleGrid(int width, int height)
      : width_(width),
        height_(height),
        codes_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {}

  int width() const { return width_; }
  int height() const { return height_; }
  std::span<SampleCode> column(int x) { return {codes_.data() + start(x), size()}; }
  SampleCode at(int x, int y) const { return codes_[start(x) + static_cast<std::size_t>(y)]; }

 private:
  std::size_t size() const { return static_cast<std::size_t>(height_); }
  std::size_t start(int x) const { return static_cast<std::size_t>(x) * size(); }

  int width_;
  int height_;
  std::vector<SampleCode> codes_;
};

/// Grids of one size for reuse: fresh memory is slow at first use. Another thread may return a
/// grid, even after the end of the pool.
class GridPool {
 public:
  GridPool(int width, int height) : shared_(std::make_shared<SharedGrids>(width, height)) {}

  /// Returns to the pool when it is no longer used.
  std::shared_ptr<SampleGrid> take();

 private:
  struct SharedGrids {
    SharedGrids(int grid_width, int grid_height) : width(grid_width), height(grid_height) {}

    int width;
    int height;
    std::mutex mutex;
    std::vector<std::unique_ptr<SampleGrid>> grids;
  };
  std::shared_ptr<SharedGrids> shared_;
};

/// Colour of each code. `outline_strength`: see outline_color().
std::vector<Rgb> colors_by_code(std::span<const Rgb> palette, double outline_strength);

/// Picture with the mean colours of `samples` x `samples` samples per pixel. `color_at(x, y)`:
/// colour of a sample, from the lower left.
template <class ColorAt>
Image mean_picture(int width, int height, int samples, ColorAt color_at) {
  constexpr int kBlock = 16;  // pixels side by side that share lines of memory, here and there
  const int count = samples * samples;
  Image image(width, height, Rgb{});
  const auto pixel = [&](int left, int low) {
    int red = count / 2;
    int green = count / 2;
    int blue = count / 2;
    for (int x = left; x < left + samples; ++x) {
      for (int y = low; y < low + samples; ++y) {
        const Rgb color = color_at(x, y);
        red += color.red;
        green += color.green;
        blue += color.blue;
      }
    }
    return Rgb{static_cast<std::uint8_t>(red / count), static_cast<std::uint8_t>(green / count),
               static_cast<std::uint8_t>(blue / count)};
  };
  for (int block = 0; block < width; block += kBlock) {
    for (int y = 0; y < height; ++y) {
      for (int x = block; x < std::min(width, block + kBlock); ++x) {
        image.at(x, height - 1 - y) = pixel(x * samples, y * samples);
      }
    }
  }
  return image;
}

}  // namespace clca::render
