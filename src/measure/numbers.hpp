#pragma once
// Numbers of several measures: positions on an edge of cells, columns, lines, where an edge lies on
// a site and rounding must not decide.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "clca/measure/grid.hpp"

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

/// Number of the part that ends at an edge; else as part_at().
inline double part_before(double position) {
  return std::ceil(position - kRounding) - 1;
}

/// The nearest of `count` parts.
inline std::size_t nearest_part(double part, std::size_t count) {
  return static_cast<std::size_t>(std::clamp(part, 0.0, static_cast<double>(count) - 1));
}

/// Calls visit(part, share) for the parts that a position is in, of `count` equal ones: an edge
/// between two belongs half to each, so that the mirror image of a bed has the mirror image of its
/// table. A position beyond an end is in the last part there.
template <class Visit>
void share_out(double position, std::size_t count, const Visit& visit) {
  share_out(nearest_part(part_before(position), count), nearest_part(part_at(position), count),
            visit);
}

/// The component of the vector product at right angles to the plane.
inline double cross_product(const Eigen::Vector2d& one, const Eigen::Vector2d& other) {
  return one.x() * other.y() - one.y() * other.x();
}

}  // namespace clca::measure
