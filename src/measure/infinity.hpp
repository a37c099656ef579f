#pragma once
// Start value of searches for minima and maxima.

#include <limits>

namespace clca::measure {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace clca::measure
