#include "clca/scene/units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "clca/contact/contact_model.hpp"
#include "clca/lattice/lattice.hpp"
#include "clca/scene/contact.hpp"

namespace clca::scene {

std::string Conversion::time_text(std::uint64_t steps) const {
  constexpr int kMaxDecimals = 12;
  int decimals = 0;
  for (double least = time_step; least < 1 && decimals < kMaxDecimals; least *= 10) {
    ++decimals;
  }
  return fmt::format("{:.{}f} {}", time(steps), decimals, time_unit);
}

std::optional<SiUnit> Conversion::si(std::string_view unit) const {
  if (!site) {
    return std::nullopt;
  }
  const double grain_weight = site->weight * mean_mass;
  const std::array<std::pair<std::string_view, SiUnit>, 5> known = {
      {{kForceUnit, {"N", site->weight}},
       {kContactForceUnit, {"N", grain_weight}},
       {kStressUnit, {"N/m", grain_weight / spacing}},
       {kEnergyUnit, {"J", site->weight * spacing}},
       {kMomentUnit, {"N m", site->weight * spacing}}}};
  const auto* found = std::ranges::find(known, unit, &decltype(known)::value_type::first);
  return found != known.end() ? std::optional(found->second) : std::nullopt;
}

double Conversion::in_si(double value, std::string_view unit) const {
  const auto found = si(unit);
  return found ? value * found->value : value;
}

bool has_density(const Scene& scene) {
  return scene.units && scene.units->density;
}

std::optional<Conversion> conversion(const Scene& scene) {
  if (scene.model != Model::contact) {
    return std::nullopt;
  }
  const double gravity = contact::gravity(contact_parameters(scene));
  if (!scene.units) {
    return Conversion{.length_unit = "spacing",
                      .time_unit = "√(spacing/gravity)",
                      .velocity_unit = "√(spacing·gravity)",
                      .spacing = 1,
                      .time_step = std::sqrt(gravity)};
  }
  const Units& units = *scene.units;
  Conversion result = {.length_unit = "m",
                       .time_unit = "s",
                       .velocity_unit = "m/s",
                       .spacing = units.spacing,
                       .time_step = std::sqrt(gravity * units.spacing / units.gravity)};
  if (units.density) {
    const double mass = *units.density * lattice::kColumnPitch * units.spacing * units.spacing;
    result.site = {.mass = mass, .weight = mass * units.gravity};
  }
  return result;
}

double steps_until(double time, const Conversion& conversion) {
  constexpr double kRounding = 1e-12;
  return std::max(1.0, std::ceil(time / conversion.time_step * (1 - kRounding)));
}

}  // namespace clca::scene
