#include "clca/scene/units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "clca/contact/contact_model.hpp"
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
  return Conversion{.length_unit = "m",
                    .time_unit = "s",
                    .velocity_unit = "m/s",
                    .spacing = scene.units->spacing,
                    .time_step = std::sqrt(gravity * scene.units->spacing / scene.units->gravity)};
}

double steps_until(double time, const Conversion& conversion) {
  constexpr double kRounding = 1e-12;
  return std::max(1.0, std::ceil(time / conversion.time_step * (1 - kRounding)));
}

}  // namespace clca::scene
