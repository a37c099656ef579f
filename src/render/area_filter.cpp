#include "clca/render/area_filter.hpp"

#include <algorithm>
#include <array>
#include <vector>

namespace clca::render {

namespace {

using Sums = std::array<std::uint64_t, 3>;

/// A pixel of the original and how much of it a new one covers.
struct Part {
  int index = 0;
  std::uint64_t weight = 0;  ///< in parts of `to` to an original pixel
};

/// For each of `to` new pixels, the original pixels (of `from`) that it covers. Weights sum to
/// `from`.
std::vector<std::vector<Part>> parts_of(int from, int to) {
  std::vector<std::vector<Part>> result(static_cast<std::size_t>(to));
  for (std::int64_t i = 0; i < to; ++i) {
    const std::int64_t begin = i * from;
    const std::int64_t end = begin + from;
    for (std::int64_t k = begin / to; k * to < end; ++k) {
      const std::int64_t covered = std::min(end, (k + 1) * to) - std::max(begin, k * to);
      result[static_cast<std::size_t>(i)].push_back(
          {static_cast<int>(k), static_cast<std::uint64_t>(covered)});
    }
  }
  return result;
}

void add(Sums& sums, std::uint64_t weight, const Sums& values) {
  for (std::size_t channel = 0; channel < 3; ++channel) {
    sums[channel] += weight * values[channel];
  }
}

/// One row of the original, summed up along x.
void sum_row(const Image& image, int row, const std::vector<std::vector<Part>>& columns,
             std::vector<Sums>& sums) {
  for (std::size_t x = 0; x < columns.size(); ++x) {
    sums[x] = {};
    for (const Part& part : columns[x]) {
      const Rgb pixel = image.at(part.index, row);
      add(sums[x], part.weight, {pixel.red, pixel.green, pixel.blue});
    }
  }
}

}  // namespace

Image scaled(const Image& image, int width, int height) {
  const auto columns = parts_of(image.width, width);
  const auto rows = parts_of(image.height, height);
  const std::uint64_t whole =
      static_cast<std::uint64_t>(image.width) * static_cast<std::uint64_t>(image.height);
  const auto mean = [whole](std::uint64_t sum) {
    return static_cast<std::uint8_t>((sum + whole / 2) / whole);
  };
  Image result(width, height, Rgb{});
  std::vector<Sums> line(static_cast<std::size_t>(width));
  for (int y = 0; y < height; ++y) {
    std::vector<Sums> sums(line.size(), Sums{});
    for (const Part& part : rows[static_cast<std::size_t>(y)]) {
      sum_row(image, part.index, columns, line);
      for (std::size_t x = 0; x < line.size(); ++x) {
        add(sums[x], part.weight, line[x]);
      }
    }
    for (int x = 0; x < width; ++x) {
      const Sums& sum = sums[static_cast<std::size_t>(x)];
      result.at(x, y) = {mean(sum[0]), mean(sum[1]), mean(sum[2])};
    }
  }
  return result;
}

}  // namespace clca::render
