#include "render/samples.hpp"

#include <algorithm>

namespace clca::render {

namespace {

template <std::size_t kCount>
void set_to_sample_means(std::span<Rgb> pixels, const Sample* samples, std::size_t pitch) {
  constexpr std::uint32_t kAll = kCount * kCount;
  const auto for_each = [&](auto act) {
    for (std::size_t y = 0; y < kCount; ++y) {
      for (std::size_t x = 0; x < kCount; ++x) {
        act(samples[y * pitch + x]);
      }
    }
  };
  Sample last = 0;
  for (Rgb& pixel : pixels) {
    Sample unlike = 0;
    for_each([&](Sample color) { unlike |= color ^ last; });
    if (unlike == 0) {  // most pixels
      pixel = to_rgb(last);
    } else {
      std::uint32_t red_blue = 0;
      std::uint32_t green = 0;
      for_each([&](Sample color) {
        red_blue += color & 0xFF00FFU;
        green += color & 0xFF00U;
      });
      const auto mean = [](std::uint32_t sum) {
        return static_cast<std::uint8_t>((sum + kAll / 2) / kAll);
      };
      pixel = {mean(red_blue >> 16U), mean(green >> 8U), mean(red_blue & 0xFFFFU)};
      last = samples[0];
    }
    samples += kCount;
  }
}

}  // namespace

void set_to_sample_means(std::span<Rgb> pixels, const Sample* samples, std::size_t pitch,
                         int count) {
  switch (count) {
    case 1:
      return set_to_sample_means<1>(pixels, samples, pitch);
    case 2:
      return set_to_sample_means<2>(pixels, samples, pitch);
    case 3:
      return set_to_sample_means<3>(pixels, samples, pitch);
    default:
      return set_to_sample_means<4>(pixels, samples, pitch);
  }
}

Image averaged_over_background(const Image& behind, std::vector<Sample> samples, int count) {
  Image image(behind.width / count, behind.height / count, {});
  const auto row = [&](int y) { return samples.data() + std::ptrdiff_t{y} * behind.width; };
  for (int y = 0; y < behind.height; ++y) {
    const Rgb* there = behind.pixels.data() + std::ptrdiff_t{behind.height - 1 - y} * behind.width;
    std::transform(row(y), row(y + 1), there, row(y), [](Sample sample, Rgb color) {
      return sample == 0 ? to_sample(color) : sample & 0xFFFFFFU;
    });
  }
  for (int y = 0; y < image.height; ++y) {
    const std::span pixels(&image.at(0, image.height - 1 - y),
                           static_cast<std::size_t>(image.width));
    set_to_sample_means(pixels, row(y * count), static_cast<std::size_t>(behind.width), count);
  }
  return image;
}

}  // namespace clca::render
