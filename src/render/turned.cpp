#include "clca/render/turned.hpp"

#include <cmath>
#include <numbers>

namespace clca::render {

Image turned(const Image& image, double degrees, Rgb blank) {
  const double angle = degrees * std::numbers::pi / 180;
  const double sine = std::sin(angle);
  const double cosine = std::cos(angle);
  const double middle_x = 0.5 * (image.width - 1);
  const double middle_y = 0.5 * (image.height - 1);
  const auto pixel = [&](int x, int y) {
    const bool inside = x >= 0 && y >= 0 && x < image.width && y < image.height;
    return inside ? image.at(x, y) : blank;
  };
  Image result(image.width, image.height, blank);
  for (int row = 0; row < image.height; ++row) {
    for (int column = 0; column < image.width; ++column) {
      // Back to where it comes from; rows go down.
      const double right = column - middle_x;
      const double down = row - middle_y;
      const double x = middle_x + cosine * right - sine * down;
      const double y = middle_y + sine * right + cosine * down;
      const double left_column = std::floor(x);
      const double upper_row = std::floor(y);
      const int left = static_cast<int>(left_column);
      const int upper = static_cast<int>(upper_row);
      const auto mean = [&](std::uint8_t Rgb::*channel) {
        const auto along_row = [&](int at) {
          const double share = x - left_column;
          return (1 - share) * pixel(left, at).*channel + share * pixel(left + 1, at).*channel;
        };
        const double share = y - upper_row;
        return static_cast<std::uint8_t>(
            std::lround((1 - share) * along_row(upper) + share * along_row(upper + 1)));
      };
      result.at(column, row) = {mean(&Rgb::red), mean(&Rgb::green), mean(&Rgb::blue)};
    }
  }
  return result;
}

}  // namespace clca::render
