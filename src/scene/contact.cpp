#include "clca/scene/contact.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "clca/contact/contact_model.hpp"
#include "clca/lattice/lattice.hpp"
#include "clca/scene/units.hpp"

namespace clca::scene {

namespace {

constexpr double kPacking = 0.8;

/// Area of the particles of a fill in squared lattice spacings; of a mixture, where it fills its
/// region as densely as a bed.
double area(const Scene& scene, const Fill& fill) {
  if (fill.counts.empty()) {
    const lattice::Rectangle& region = fill.region;
    return kPacking * (std::min(region.right, scene.box.width) - std::max(region.left, 0.0)) *
           (std::min(fill.level.value_or(region.top), scene.box.height) -
            std::max(region.bottom, 0.0));
  }
  double sum = 0;
  for (std::size_t i = 0; i < fill.counts.size(); ++i) {
    sum += static_cast<double>(fill.counts[i]) * static_cast<double>(scene.species[i].shape.size());
  }
  return sum * lattice::kColumnPitch;
}

/// The highest fall that the scene allows, in lattice spacings: from the top of the highest fill to
/// the floor, or right across a box whose vessel turns.
double highest_fall(const Scene& scene) {
  double highest = 0;
  for (const Stage& stage : scene.stages) {
    if (stage.vessel && !std::holds_alternative<VesselShake>(*stage.vessel)) {
      return std::hypot(scene.box.width, scene.box.height);
    }
    if (stage.fill) {
      highest = std::max(highest, std::min(stage.fill->region.top, scene.box.height));
    }
  }
  return highest;
}

double estimated_fall(const Scene& scene) {
  double filled = 0;
  double width = 0;
  for (const Stage& stage : scene.stages) {
    if (stage.fill) {
      const lattice::Rectangle& region = stage.fill->region;
      filled += area(scene, *stage.fill);
      width = std::max(width, std::min(region.right, scene.box.width) - std::max(region.left, 0.0));
    }
  }
  const bool endless =
      std::ranges::any_of(scene.sources, [](const Source& source) { return !source.count; });
  if (endless || width <= 0 || scene.begin) {
    return contact::default_fall_height(scene.box.height);
  }
  // What falls from the highest point is to be no faster than a site a step.
  const double slow_enough =
      scene.contact.resolution * scene.contact.resolution * highest_fall(scene);
  return std::max(slow_enough, std::clamp(filled / (kPacking * width), contact::kMinFallHeight,
                                          contact::default_fall_height(scene.box.height)));
}

}  // namespace

contact::Parameters contact_parameters(const Scene& scene) {
  contact::Parameters parameters = scene.contact;
  if (parameters.fall_height == 0) {
    parameters.fall_height = estimated_fall(scene);
  }
  for (const Wall& wall : scene.walls) {
    parameters.friction_by_wall.push_back(wall.friction);
  }
  return parameters;
}

contact::Parameters contact_parameters(const Scene& scene, const Stage& stage) {
  const contact::Parameters of_scene = contact_parameters(scene);
  contact::Parameters parameters = stage.contact.value_or(of_scene);
  parameters.fall_height = of_scene.fall_height;
  parameters.friction_by_wall = of_scene.friction_by_wall;
  return parameters;
}

std::optional<Eigen::Vector2d> turning_centre(const Scene& scene, const Stage& stage) {
  const auto* tilt = stage.vessel ? std::get_if<Tilt>(&*stage.vessel) : nullptr;
  const auto* rotate = stage.vessel ? std::get_if<Rotate>(&*stage.vessel) : nullptr;
  if (rotate == nullptr && (tilt == nullptr || !tilt->rate)) {
    return std::nullopt;
  }
  const Eigen::Vector2d middle(scene.box.width / 2, scene.box.height / 2);
  return rotate != nullptr ? rotate->centre.value_or(middle) : middle;
}

contact::Vessel vessel_in(const Scene& scene, const Stage& stage, const contact::Vessel& before) {
  const double step = conversion(scene)->time_step;
  if (!stage.vessel) {
    return at_rest(before);
  }
  if (const auto* tilt = std::get_if<Tilt>(&*stage.vessel)) {
    const contact::Angle to = contact::angle_of(tilt->to);
    return tilt->rate ? tilting(before, to, *tilt->rate * step, *turning_centre(scene, stage))
                      : tilted(before, to);
  }
  if (const auto* rotate = std::get_if<Rotate>(&*stage.vessel)) {
    return rotating(before, rotate->rate * step, *turning_centre(scene, stage));
  }
  const auto& shake = std::get<VesselShake>(*stage.vessel);
  const double gravity = contact::gravity(contact_parameters(scene));
  const double radians = std::sqrt(shake.gamma * gravity / shake.amplitude);
  return shaken(before, shake.gamma, radians / (2 * std::numbers::pi), shake.sideways);
}

}  // namespace clca::scene
