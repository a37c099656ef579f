#pragma once
// What lies beneath every sample of a picture, before it has a colour.

#include <algorithm>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "clca/render/image.hpp"

namespace clca::render {

/// What a sample shows: one of these, or a particle.
enum class Ground : std::uint8_t { paper, wall, moving_wall };
inline constexpr std::size_t kGrounds = 3;

using SampleCode = std::uint16_t;

constexpr SampleCode code_of(Ground ground) {
  return static_cast<SampleCode>(ground);
}
/// Of a particle, or of its outline.
constexpr SampleCode code_of(std::size_t shade, bool outlined) {
  return static_cast<SampleCode>(kGrounds + 2 * shade + (outlined ? 1 : 0));
}

/// Samples up the columns, from the lower left one.
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

/// Grids of one size that are used again and again: memory from the system is dear at first use.
/// Grids may be given back by another thread, and outlive the pool.
class GridPool {
 public:
  GridPool(int width, int height) : spare_(std::make_shared<Spare>(width, height)) {}

  /// Goes back when it is no longer used.
  std::shared_ptr<SampleGrid> take();

 private:
  struct Spare {
    Spare(int grid_width, int grid_height) : width(grid_width), height(grid_height) {}

    int width;
    int height;
    std::mutex mutex;
    std::vector<std::unique_ptr<SampleGrid>> grids;
  };
  std::shared_ptr<Spare> spare_;
};

/// Colours by code. `outline_strength`: see outline_color().
std::vector<Rgb> colors_by_code(std::span<const Rgb> palette, double outline_strength);

/// Mean colours of `samples` x `samples` samples a pixel. `color_at(x, y)`: of a sample, from the
/// lower left one.
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
