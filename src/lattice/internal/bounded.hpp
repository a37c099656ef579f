#pragma once
// Coordinates as numbers of columns and rows.

#include <algorithm>
#include <cmath>

namespace clca::lattice {

/// `value` rounded down, from `low` to `high`.
inline int bounded(double value, int low, int high) {
  const double whole = std::floor(value);
  return static_cast<int>(std::clamp(whole, static_cast<double>(low), static_cast<double>(high)));
}

}  // namespace clca::lattice
