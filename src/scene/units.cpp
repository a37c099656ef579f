#include "clca/scene/units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "clca/contact/contact_model.hpp"
#include "clca/lattice/lattice.hpp"

namespace clca::scene {

namespace {

constexpr double kPacking = 0.8;

/// Area of the particles of a fill, squared lattice spacings; a mixture is as dense as a bed.
double area(const Scene& scene, const Fill& fill) {
  if (fill.species_counts.empty()) {
    const lattice::Rectangle& region = fill.region;
    return kPacking * (std::min(region.right, scene.box.width) - std::max(region.left, 0.0)) *
           (std::min(fill.level.value_or(region.top), scene.box.height) -
            std::max(region.bottom, 0.0));
  }
  double sum = 0;
  for (std::size_t i = 0; i < fill.species_counts.size(); ++i) {
    sum += static_cast<double>(fill.species_counts[i]) *
           static_cast<double>(scene.species[i].shape.size());
  }
  return sum * lattice::kColumnPitch;
}

/// The highest fall that the scene allows, in lattice spacings: from the top of the highest fill to
/// the floor, or right across a box whose vessel turns.
double highest_fall(const Scene& scene) {
  double highest = 0;
  for (const Stage& stage : scene.stages) {
    if (stage.vessel_motion && !std::holds_alternative<VesselShake>(*stage.vessel_motion)) {
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
  const bool endless = std::ranges::any_of(
      scene.sources, [](const Source& source) { return !source.max_particles; });
  const double most = std::max(contact::kMinFallHeight, scene.box.height);
  if (endless || width <= 0 || scene.initial_state) {
    return most;
  }
  // What falls from the highest point is to be no faster than a site a step.
  const double slow_enough = scene.contact_parameters.resolution *
                             scene.contact_parameters.resolution * highest_fall(scene);
  return std::max(slow_enough,
                  std::clamp(filled / (kPacking * width), contact::kMinFallHeight, most));
}

}  // namespace

contact::Parameters contact_parameters(const Scene& scene) {
  contact::Parameters parameters = scene.contact_parameters;
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
  contact::Parameters parameters = stage.contact_parameters.value_or(of_scene);
  parameters.fall_height = of_scene.fall_height;
  parameters.friction_by_wall = of_scene.friction_by_wall;
  return parameters;
}

std::optional<Eigen::Vector2d> turning_centre(const Scene& scene, const Stage& stage) {
  const auto* tilt = stage.vessel_motion ? std::get_if<Tilt>(&*stage.vessel_motion) : nullptr;
  const auto* rotate = stage.vessel_motion ? std::get_if<Rotate>(&*stage.vessel_motion) : nullptr;
  if (rotate == nullptr && (tilt == nullptr || !tilt->degrees_per_time)) {
    return std::nullopt;
  }
  const Eigen::Vector2d middle(scene.box.width / 2, scene.box.height / 2);
  return rotate != nullptr ? rotate->centre.value_or(middle) : middle;
}

contact::Vessel vessel_at_start(const Scene& scene, const Stage& stage,
                                const contact::Vessel& before) {
  const double step = unit_conversion(scene)->time_step;
  if (!stage.vessel_motion) {
    return without_motion(before);
  }
  if (const auto* tilt = std::get_if<Tilt>(&*stage.vessel_motion)) {
    const contact::Angle to = contact::angle_from_degrees(tilt->to_degrees);
    return tilt->degrees_per_time ? with_tilting(before, to, *tilt->degrees_per_time * step,
                                                 *turning_centre(scene, stage))
                                  : contact::Vessel{.angle = to};
  }
  if (const auto* rotate = std::get_if<Rotate>(&*stage.vessel_motion)) {
    return with_rotation(before, rotate->turns_per_time * step, *turning_centre(scene, stage));
  }
  const auto& shake = std::get<VesselShake>(*stage.vessel_motion);
  const double gravity = contact::gravity(contact_parameters(scene));
  const double radians = std::sqrt(shake.gamma * gravity / shake.amplitude);
  return with_shaking(before, shake.gamma, radians / (2 * std::numbers::pi), shake.sideways);
}

std::string UnitConversion::time_text(std::uint64_t steps) const {
  constexpr int kMaxDecimals = 12;
  int decimals = 0;
  for (double least = time_step; least < 1 && decimals < kMaxDecimals; least *= 10) {
    ++decimals;
  }
  return fmt::format("{:.{}f} {}", time(steps), decimals, time_unit);
}

std::optional<SiUnit> UnitConversion::si_unit(std::string_view unit) const {
  if (!site_mass) {
    return std::nullopt;
  }
  const double grain_weight = site_mass->weight * mean_mass;
  const std::array<std::pair<std::string_view, SiUnit>, 5> known = {
      {{kForceUnit, {"N", site_mass->weight}},
       {kContactForceUnit, {"N", grain_weight}},
       {kStressUnit, {"N/m", grain_weight / spacing}},
       {kEnergyUnit, {"J", site_mass->weight * spacing}},
       {kMomentUnit, {"N m", site_mass->weight * spacing}}}};
  const auto* found = std::ranges::find(known, unit, &decltype(known)::value_type::first);
  return found != known.end() ? std::optional(found->second) : std::nullopt;
}

double UnitConversion::in_si(double value, std::string_view unit) const {
  const auto found = si_unit(unit);
  return found ? value * found->factor : value;
}

bool has_density(const Scene& scene) {
  return scene.units && scene.units->density;
}

std::optional<UnitConversion> unit_conversion(const Scene& scene) {
  if (scene.model != Model::contact) {
    return std::nullopt;
  }
  const double gravity = contact::gravity(contact_parameters(scene));
  if (!scene.units) {
    return UnitConversion{.length_unit = "spacing",
                          .time_unit = "√(spacing/gravity)",
                          .velocity_unit = "√(spacing·gravity)",
                          .spacing = 1,
                          .time_step = std::sqrt(gravity)};
  }
  const Units& units = *scene.units;
  UnitConversion result = {.length_unit = "m",
                           .time_unit = "s",
                           .velocity_unit = "m/s",
                           .spacing = units.spacing,
                           .time_step = std::sqrt(gravity * units.spacing / units.gravity)};
  if (units.density) {
    const double mass = *units.density * lattice::kColumnPitch * units.spacing * units.spacing;
    result.site_mass = {.mass = mass, .weight = mass * units.gravity};
  }
  return result;
}

double steps_until(double time, const UnitConversion& conversion) {
  constexpr double kRounding = 1e-12;
  return std::max(1.0, std::ceil(time / conversion.time_step * (1 - kRounding)));
}

}  // namespace clca::scene
