#pragma once
// What all formats say of a state.

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "clca/grains/state.hpp"
#include "clca/scene/scene.hpp"
#include "clca/store/trajectory.hpp"

namespace clca::exports {

/// A particle that is present; lengths in lattice spacings.
struct Body {
  Eigen::Vector2d centre;        ///< of mass, in the box
  Eigen::Vector2d velocity;      ///< of the automaton the last move: spacings a step
  Eigen::Vector2d displacement;  ///< from its origin, across a periodic seam too
  std::uint32_t id = 0;
  int image = 0;    ///< widths of a periodic box that it has gone to the right
  float force = 0;  ///< of the automaton see measure::force_indices, else contact::loads
  std::uint16_t kind = 0;
};

/// By id. Velocities of the contact model are multiplied by `velocity_unit`.
std::vector<Body> bodies(const grains::State& state, const store::ContactFrame& contact = {},
                         double velocity_unit = 1);

/// What the particles of a kind have in common.
struct KindLook {
  std::string name;  ///< SPECIES, or SPECIES@DEGREES where the species has several kinds
  std::uint16_t species = 0;
  std::vector<Eigen::Vector2d> outline;  ///< corners from the centre of mass, anticlockwise
};

/// Of a step in the unit of time of the run: 1 where that is a step.
double time_step(const scene::Scene& scene);
/// Of a spacing a step in the unit of velocity of the run: likewise.
double velocity_unit(const scene::Scene& scene);

std::vector<KindLook> kind_looks(const scene::Scene& scene, const std::vector<grains::Kind>& kinds);

}  // namespace clca::exports
