#pragma once
// Forces of the last step: impulses over the time that they took.

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "clca/contact/state.hpp"

namespace clca::contact {

/// Between a grain and what it touches, in weights of a grain of mean mass.
struct Force {
  std::uint32_t upper = 0;
  grains::Owner other = 0;                           ///< a grain, a wall or a side of the box
  Eigen::Vector2d place = Eigen::Vector2d::Zero();   ///< of contact, in lattice spacings
  Eigen::Vector2d normal = Eigen::Vector2d::Zero();  ///< of length 1, towards the upper grain
  double along_normal = 0;                           ///< not negative
  double along_shear = 0;                            ///< on the normal turned anticlockwise

  /// On the upper grain; the other body has the opposite one.
  Eigen::Vector2d on_upper() const {
    return along_normal * normal + along_shear * Eigen::Vector2d(-normal.y(), normal.x());
  }
};

/// All of them, in the order of the contacts. `gravity` in lattice spacings per step squared. In a
/// periodic box places are near the upper grain.
std::vector<Force> forces(const State& state, double gravity);

/// Mean mass of the grains that are present, in sites; 0 where there are none.
double mean_mass(const grains::State& state);

/// What forces and weight of each grain do not balance, over its weight, by id; 0 of grains that
/// have left. `down`: of length 1, the direction of gravity.
std::vector<double> residuals(const grains::State& state, const std::vector<Force>& forces,
                              const Eigen::Vector2d& down);

}  // namespace clca::contact
