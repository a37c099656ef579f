#pragma once
// What a scene leaves to the contact model to find out.

#include "clca/contact/vessel.hpp"
#include "clca/scene/scene.hpp"

namespace clca::scene {

/// The parameters of a scene of the contact model. Where it gives no fall height, that is the
/// height which all its fills have together at a packing fraction of 0.8 in the widest of their
/// regions; that of the box where there are sources without a count, or no fills.
contact::Parameters contact_parameters(const Scene& scene);

/// The vessel as a stage begins, after one that left it as `before`. Throws std::invalid_argument
/// for a motion that is too fast or too slow for the time step.
contact::Vessel vessel_in(const Scene& scene, const Stage& stage, const contact::Vessel& before);

}  // namespace clca::scene
