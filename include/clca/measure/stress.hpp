#pragma once
// Stress of the contact forces on the cells of a grid.

#include <span>
#include <vector>

#include "clca/contact/force.hpp"
#include "clca/measure/grid.hpp"

namespace clca::measure {

/// In weights of a grain of mean mass per lattice spacing; compression is positive.
struct StressCell {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();  ///< lattice spacings
  double xx = 0;
  double xy = 0;  ///< of the symmetric part
  double yy = 0;

  double pressure() const { return (xx + yy) / 2; }
};

/// Contact stress 1/A sum(force x branch vector) on a Grid of side `cell` (lattice spacings).
/// Each cell takes the part of a branch inside it (Irving & Kirkwood 1950), so that yy averaged
/// over a row of cells is the weight carried there. A wall carries a force on, against the normal,
/// to its far side or to the side of the box behind it. The kinetic part is left out.
std::vector<StressCell> stress_field(const grains::State& state,
                                     std::span<const contact::Force> forces, double cell);

}  // namespace clca::measure
