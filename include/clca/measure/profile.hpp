#pragma once
// The free surface and quantities derived from it.

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "clca/grains/state.hpp"

namespace clca::measure {

/// Height of the free surface above the floor of the box, one value per column from the left,
/// lattice spacings: the top of the highest particle site, 0 if there is none.
std::vector<double> surface_profile(const grains::State& state);

/// The profile in a frame in which gravity points down: heights above the lowest site, from the
/// leftmost site on.
/// `down` is a unit vector. Not for periodic boxes; empty if there are no particles.
std::vector<double> surface_profile(const grains::State& state, const Eigen::Vector2d& down);

/// Mean of the profile over columns with particles; 0 if there are none.
double mean_height(const std::vector<double>& profile);

/// Slopes of both flanks of a pile, if present.
struct ReposeAngle {
  struct Flank {
    std::optional<double> degrees = {};
    bool is_uneven = false;  ///< none, since no single slope describes it
  };
  Flank left;
  Flank right;

  /// Mean of the flanks that are present.
  std::optional<double> mean_degrees() const;
};

/// Least-squares lines through the columns on either side of the top with 15 % to 80 % of the
/// maximum height, so that a flat top or scattered grains at the toe do not count.
/// A flank has at least 5 columns, and the line explains at least a quarter of the variance of
/// their heights; where it explains less the flank is uneven.
ReposeAngle repose_angle(const std::vector<double>& profile);

/// Particle sites divided by the sites available to the bed: per column from the floor or wall
/// below the lowest particle up to the highest particle, without walls.
/// Shared sites count twice (nominal packing under a piston). None for an empty box.
std::optional<double> packing_fraction(const grains::State& state);

}  // namespace clca::measure
