#include "run/overlay_scales.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "clca/scene/contact.hpp"
#include "clca/scene/units.hpp"

namespace clca::run {

namespace {

double mean_diameter(const scene::Scene& scene) {
  double diameters = 0;
  for (const scene::Species& species : scene.species) {
    diameters += species.shape.diameter();
  }
  return diameters / static_cast<double>(scene.species.size());
}

/// The largest of 1, 2 and 5 times a power of ten that is not above `number` (positive).
double rounded_down(double number) {
  const double power = std::pow(10, std::floor(std::log10(number)));
  const double leading = number / power;
  return power * (leading < 2 ? 1 : leading < 5 ? 2 : 5);
}

double strongest_force(const scene::Scene& scene, const scene::Frames& frames) {
  return frames.force_scale.value_or(
      rounded_down(2 * scene::contact_parameters(scene).fall_height / mean_diameter(scene)));
}

double velocity_cell(const scene::Scene& scene, const scene::Frames& frames) {
  constexpr double kDiameters = 3;
  constexpr double kMostAcross = 30;  // cells along the longer side of the view
  const double width = frames.view ? frames.view->right - frames.view->left : scene.box.width;
  const double height = frames.view ? frames.view->top - frames.view->bottom : scene.box.height;
  const double least = std::max(width, height) / kMostAcross;
  return frames.velocity_cell.value_or(std::max(kDiameters * mean_diameter(scene), least));
}

/// In lattice spacings per step.
double default_velocity(const scene::Scene& scene) {
  constexpr double kOfAutomaton = 0.5;
  constexpr double kOfFreeFall = 0.5;
  // The resolution is what a fall from the fall height ends with.
  return scene.model == scene::Model::contact ? kOfFreeFall * scene.contact.resolution
                                              : kOfAutomaton;
}

}  // namespace

OverlayScales overlay_scales(const scene::Scene& scene) {
  const scene::Frames& frames = *scene.output.frames;
  OverlayScales scales = {
      .strongest_force = strongest_force(scene, frames),
      .velocity_cell = velocity_cell(scene, frames),
      .velocity_unit = {.one = "spacing per step", .several = "spacings per step"}};
  scales.highest_pressure = scales.strongest_force / mean_diameter(scene);
  if (const auto conversion = scene::conversion(scene)) {
    scales.step_velocity = conversion->velocity(1);
    scales.velocity_unit = {.one = conversion->velocity_unit, .several = conversion->velocity_unit};
  }
  scales.highest_velocity =
      frames.velocity_scale.value_or(rounded_down(scales.step_velocity * default_velocity(scene)));
  if (const auto conversion = scene::conversion(scene)) {
    scales.highest_spin =
        2 * scales.highest_velocity / (mean_diameter(scene) * conversion->spacing);
  }
  return scales;
}

}  // namespace clca::run
