#include "clca/render/difference.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <stdexcept>

namespace clca::render {

namespace {

constexpr Rgb kStrong = {213, 0, 60};

int channel_difference(Rgb a, Rgb b) {
  return std::max(
      {std::abs(a.red - b.red), std::abs(a.green - b.green), std::abs(a.blue - b.blue)});
}

Rgb pale(Rgb color) {
  const int gray = (2 * color.red + 5 * color.green + color.blue) / 8;
  const auto light = static_cast<std::uint8_t>(190 + gray / 4);
  return {light, light, light};
}

}  // namespace

Difference difference_of(const Image& first, const Image& second, int tolerance) {
  if (first.width != second.width || first.height != second.height) {
    throw std::invalid_argument(fmt::format("the pictures differ in size: {} x {} and {} x {}",
                                            first.width, first.height, second.width,
                                            second.height));
  }
  Difference result;
  result.picture = Image(first.width, first.height, Rgb{});
  for (int y = 0; y < first.height; ++y) {
    for (int x = 0; x < first.width; ++x) {
      const int change = channel_difference(first.at(x, y), second.at(x, y));
      result.largest_difference = std::max(result.largest_difference, change);
      if (change > tolerance) {
        ++result.differing_pixels;
        result.differing_box.extend(Eigen::Vector2i(x, y));
      }
      result.picture.at(x, y) = change > tolerance ? kStrong : pale(first.at(x, y));
    }
  }
  return result;
}

}  // namespace clca::render
