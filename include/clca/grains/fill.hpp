#pragma once
// What comes of placing particles.

#include <cstddef>
#include <vector>

namespace clca::grains {

/// How many particles a fill has placed.
struct FillResult {
  std::vector<std::size_t> placed;  ///< per species
  bool complete = true;
};

}  // namespace clca::grains
