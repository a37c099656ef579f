#pragma once
// How two pictures differ.

#include <Eigen/Geometry>

#include "clca/render/image.hpp"

namespace clca::render {

struct Difference {
  std::size_t differing_pixels = 0;   ///< number of those above the tolerance in some channel
  int largest_difference = 0;         ///< channel difference, 0 to 255
  Eigen::AlignedBox2i differing_box;  ///< around those pixels, corners included; empty if none
  Image picture;                      ///< the first picture pale, differing pixels strong
};

/// Throws std::invalid_argument when the sizes differ. `tolerance`: channel difference, 0 to 255,
/// up to which two pixels count as alike.
Difference difference_of(const Image& first, const Image& second, int tolerance);

}  // namespace clca::render
