#pragma once
// Numbers of several measures. Positions on an edge: of cells, columns, lines. Where an edge lies
// on a site, rounding must not decide.

#include <cmath>
#include <limits>

namespace clca::measure {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// More than the rounding of any position, far less than the distance of a centre of mass from an
/// edge on which it does not lie: both are whole multiples of small fractions of a spacing.
inline constexpr double kRounding = 1e-9;  // lattice spacings, or shares of a part

/// Number of the equal part, counted from 0, that contains a position given in lengths of a part.
/// An edge belongs to the part after it.
inline double part_at(double position) {
  return std::floor(position + kRounding);
}

}  // namespace clca::measure
