#pragma once
// How two pictures differ.

#include <Eigen/Geometry>

#include "clca/render/image.hpp"

namespace clca::render {

struct Difference {
  std::size_t pixels = 0;   ///< that differ by more than the tolerance in some channel
  int largest = 0;          ///< channel difference, 0 to 255
  Eigen::AlignedBox2i box;  ///< the smallest around those pixels, both corners in it; empty if none
  Image picture;            ///< the first picture pale, differing pixels strong
};

/// Throws std::invalid_argument when the sizes differ. `tolerance`: channel difference, 0 to 255,
/// up to which two pixels count as alike.
Difference difference_of(const Image& first, const Image& second, int tolerance);

}  // namespace clca::render
