#pragma once
// Stress of the contact forces on the cells of a grid.

#include <span>
#include <vector>

#include "clca/contact/force.hpp"
#include "clca/measure/grid.hpp"

namespace clca::measure {

/// In weights of a grain of mean mass per lattice spacing; pressed is positive.
struct StressCell {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();  ///< lattice spacings
  double xx = 0;
  double xy = 0;  ///< of the symmetric part
  double yy = 0;

  double pressure() const { return (xx + yy) / 2; }
};

/// 1/A times the sum over contacts of force x branch vector, in the order of a Grid of side `cell`
/// (lattice spacings). Each cell has the share of a branch that lies within it (Irving & Kirkwood
/// 1950), so that the yy of a row of cells is the mean weight that is carried across its heights.
/// What grains carry by moving is no part of it.
std::vector<StressCell> stress_field(const grains::State& state,
                                     std::span<const contact::Force> forces, double cell);

}  // namespace clca::measure
