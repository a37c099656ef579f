#pragma once
// Data of a state as the Python package shows them.

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "clca/grains/state.hpp"
#include "clca/scene/scene.hpp"
#include "clca/scene/units.hpp"
#include "clca/store/trajectory.hpp"

namespace clca::python {

/// A present particle; lengths in lattice spacings.
struct Body {
  Eigen::Vector2d centre;        ///< of mass, in the box
  Eigen::Vector2d velocity;      ///< of the automaton the last move: spacings a step
  Eigen::Vector2d displacement;  ///< from its origin, across a periodic boundary, too
  double angular_velocity = 0;   ///< anticlockwise, radians a step; of the contact model only
  std::uint32_t id = 0;
  int image = 0;    ///< widths of a periodic box that it has gone to the right
  float force = 0;  ///< of the automaton see measure::force_indices, else contact::loads
  std::uint16_t kind = 0;
};

/// By id. With `units`, velocities and angular velocities are in these.
std::vector<Body> bodies(const grains::State& state, const store::ContactFrame& contact = {},
                         const std::optional<scene::Conversion>& units = {});

/// Appearance of a kind of particles.
struct KindAppearance {
  std::string name;  ///< SPECIES, or SPECIES@DEGREES where the species has several kinds
  std::uint16_t species = 0;
  int degrees = 0;  ///< orientation, clockwise: the first of the species that looks like this
  std::vector<Eigen::Vector2d> outline;  ///< corners from the centre of mass, anticlockwise
};

/// Length of a step in the unit of time of the run; 1 if steps have no length.
double time_step(const scene::Scene& scene);

std::vector<KindAppearance> kind_appearances(const scene::Scene& scene,
                                             const std::vector<grains::Kind>& kinds);

}  // namespace clca::python
