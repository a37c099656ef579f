#pragma once
// How two pictures differ.

#include "clca/render/image.hpp"

namespace clca::render {

struct Difference {
  std::size_t pixels = 0;     ///< that differ by more than the tolerance in some channel
  int largest = 0;            ///< channel difference, 0 to 255
  int left = 0, top = 0;      ///< of the smallest rectangle around those pixels
  int right = 0, bottom = 0;  ///< inclusive
  Image picture;              ///< the first picture pale, differing pixels strong
};

/// Throws std::invalid_argument when the sizes differ. `tolerance`: channel difference, 0 to 255,
/// up to which two pixels count as alike.
Difference difference_of(const Image& first, const Image& second, int tolerance);

}  // namespace clca::render
