#include "render/marks.hpp"

#include <algorithm>
#include <cmath>

#include "render/colors.hpp"

namespace clca::render {

namespace {

int pixel(double place) {
  return static_cast<int>(std::lround(place));
}

/// Distance from the middle in the norm whose unit ball is a hexagon of circumradius 1 standing on
/// a corner, the shape of particles.
double hexagonal_norm(double x, double y) {
  constexpr double kHalfRoot3 = 0.86602540378443864676;
  const double across = std::abs(x);
  return std::max(across, 0.5 * across + kHalfRoot3 * std::abs(y)) / kHalfRoot3;
}

/// One channel of a pixel with `bare` of `count` samples white and `dark` outline.
std::uint8_t mixed(std::uint8_t paper, std::uint8_t ink, std::uint8_t outline, int bare, int dark,
                   int count) {
  const int sum = paper * bare + outline * dark + ink * (count - bare - dark);
  return static_cast<std::uint8_t>((sum + count / 2) / count);
}

void draw_hexagon_pixel(Rgb& pixel, double dx, double dy, double radius, double outline,
                        Rgb color) {
  constexpr int kSide = 4;
  constexpr int kCount = kSide * kSide;
  int bare = 0;
  int dark = 0;
  for (int sample = 0; sample < kCount; ++sample) {
    const double norm = hexagonal_norm(dx + (sample % kSide + 0.5) / kSide,
                                       dy + (static_cast<int>(sample / kSide) + 0.5) / kSide);
    bare += norm > radius ? 1 : 0;
    dark += norm <= radius && norm > radius - outline ? 1 : 0;
  }
  const Rgb edge = outline_color(color, 1);
  pixel = {mixed(pixel.red, color.red, edge.red, bare, dark, kCount),
           mixed(pixel.green, color.green, edge.green, bare, dark, kCount),
           mixed(pixel.blue, color.blue, edge.blue, bare, dark, kCount)};
}

}  // namespace

void fill_box(Image& image, double left, double top, double right, double bottom, Rgb color) {
  const int last_x = std::min(std::max(pixel(right), pixel(left) + 1), image.width);
  const int last_y = std::min(std::max(pixel(bottom), pixel(top) + 1), image.height);
  for (int y = std::max(0, pixel(top)); y < last_y; ++y) {
    for (int x = std::max(0, pixel(left)); x < last_x; ++x) {
      image.at(x, y) = color;
    }
  }
}

void draw_hexagon(Image& image, double x, double y, double radius, double outline, Rgb color) {
  const int reach = static_cast<int>(radius) + 2;
  const int last_x = std::min(image.width, pixel(x) + reach);
  const int last_y = std::min(image.height, pixel(y) + reach);
  for (int row = std::max(0, pixel(y) - reach); row < last_y; ++row) {
    for (int column = std::max(0, pixel(x) - reach); column < last_x; ++column) {
      draw_hexagon_pixel(image.at(column, row), column - x, row - y, radius, outline, color);
    }
  }
}

}  // namespace clca::render
