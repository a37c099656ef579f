#pragma once
// Parameters of the contact model derived from a scene.

#include "clca/contact/vessel.hpp"
#include "clca/scene/scene.hpp"

namespace clca::scene {

/// The parameters of a contact scene. Default fall height: the height of all fills together at a
/// packing fraction of 0.8 in the widest of their regions; that of the box if there are sources
/// without a count, no fills, or a beginning with another run.
contact::Parameters contact_parameters(const Scene& scene);
/// The same in a stage that may have friction and restitution of its own.
contact::Parameters contact_parameters(const Scene& scene, const Stage& stage);

/// What the vessel turns about in a stage, in lattice spacings; none if it does not turn.
std::optional<Eigen::Vector2d> turning_centre(const Scene& scene, const Stage& stage);

/// The vessel at the start of a stage; the previous stage left it as `before`. Throws
/// std::invalid_argument for a motion too fast or too slow for the time step.
contact::Vessel vessel_in(const Scene& scene, const Stage& stage, const contact::Vessel& before);

}  // namespace clca::scene
