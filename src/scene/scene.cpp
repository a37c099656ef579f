#include "clca/scene/scene.hpp"

namespace clca::scene {

std::optional<std::uint64_t> steps_of(const Until& until) {
  if (const auto* time = std::get_if<UntilTime>(&until)) {
    return time->steps;
  }
  const auto* steps = std::get_if<UntilSteps>(&until);
  return steps != nullptr ? std::optional(steps->steps) : std::nullopt;
}

bool vessel_has_cycles(const Stage& stage) {
  return stage.vessel && !std::holds_alternative<Tilt>(*stage.vessel);
}

}  // namespace clca::scene
