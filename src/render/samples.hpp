#pragma once
// Several samples a pixel.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "clca/render/image.hpp"

namespace clca::render {

/// The colour of a sample, red, green and blue: 0x00RRGGBB.
using Sample = std::uint32_t;

constexpr Sample to_sample(Rgb color) {
  return (Sample{color.red} << 16U) | (Sample{color.green} << 8U) | color.blue;
}

constexpr Rgb to_rgb(Sample color) {
  return {static_cast<std::uint8_t>(color >> 16U), static_cast<std::uint8_t>(color >> 8U),
          static_cast<std::uint8_t>(color)};
}

/// Sets the pixels of a row to the means of `count` x `count` samples, 1 to 4. `samples`: the
/// lowest row of them; the others are `pitch` apart.
void set_to_sample_means(std::span<Rgb> pixels, const Sample* samples, std::size_t pitch,
                         int count);

/// The picture of the means of `samples`, row by row from the lower left. Where they are 0,
/// `behind` is seen, which has a pixel for each of them.
Image averaged_over_background(const Image& behind, std::vector<Sample> samples, int count);

}  // namespace clca::render
