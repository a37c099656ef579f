#pragma once
// Where a search for the least or the greatest begins.

#include <limits>

namespace clca::measure {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace clca::measure
