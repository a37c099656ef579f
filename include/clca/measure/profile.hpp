#pragma once
// The free surface and what is read off it.

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "clca/grains/state.hpp"

namespace clca::measure {

/// Height of the free surface above the floor of the box, one value per column from the left, in
/// lattice spacings: the top of the highest particle site there, 0 where there is none.
std::vector<double> surface_profile(const grains::State& state);

/// The same in the frame in which gravity points down: heights above the lowest site, from the
/// leftmost one on. `down`: of length 1. For boxes that are not periodic; empty where no particle
/// is.
std::vector<double> surface_profile(const grains::State& state, const Eigen::Vector2d& down);

/// Mean of the profile over the columns with particles; 0 where there are none.
double mean_height(const std::vector<double>& profile);

/// Slopes of the flanks of a pile in degrees; a flank that is not there has none.
struct ReposeAngle {
  std::optional<double> left;
  std::optional<double> right;

  /// Mean of the flanks that are there.
  std::optional<double> mean() const;
};

/// Straight lines fitted by least squares to the columns on either side of the top whose height is
/// between 15 % and 80 % of the highest column's: a flat top or scattered grains at the toe would
/// spoil the angle. A flank has at least 5 columns; an empty profile has none.
ReposeAngle repose_angle(const std::vector<double>& profile);

/// Particle sites over all sites that the bed could fill: per column from the floor or wall under
/// the lowest particle up to the highest, without walls. A site that two particles share counts
/// twice: this is the nominal packing of a bed under a piston. Nothing for an empty box.
std::optional<double> packing_fraction(const grains::State& state);

}  // namespace clca::measure
