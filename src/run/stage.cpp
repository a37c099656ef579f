#include "run/stage.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "clca/run/run.hpp"

namespace clca::run {

namespace {

void fill(automaton::Automaton& automaton, const scene::Scene& scene, const scene::Stage& stage) {
  const scene::Fill& fill = *stage.fill;
  const automaton::FillResult result = automaton.fill(fill.region, fill.counts);
  if (result.complete) {
    return;
  }
  std::string fitted;
  for (std::size_t species = 0; species < fill.counts.size(); ++species) {
    if (fill.counts[species] > 0) {
      fitted += fmt::format("{}{} of {} {}", fitted.empty() ? "" : ", ", result.placed[species],
                            fill.counts[species], scene.species[species].name);
    }
  }
  throw ScenePlaceError(
      fmt::format("{}: error: the fill of stage {} does not fit: {} fitted; enlarge the region, "
                  "lower the counts or fill in several stages",
                  fill.place, stage.name, fitted));
}

}  // namespace

void prepare_stage(automaton::Automaton& automaton, const scene::Scene& scene,
                   const scene::Stage& stage) {
  for (const std::size_t wall : stage.remove) {
    automaton.remove_wall(wall);
  }
  if (stage.fill) {
    fill(automaton, scene, stage);
  }
  for (std::size_t source = 0; source < scene.sources.size(); ++source) {
    const bool open =
        std::find(stage.sources.begin(), stage.sources.end(), source) != stage.sources.end();
    automaton.set_source(source, open);
  }
  automaton.mark_origins();
}

std::string to_text(StageEnd end) {
  switch (end) {
    case StageEnd::settled:
      return "settled";
    case StageEnd::steps:
      return "steps";
    case StageEnd::discharged:
      return "discharged";
    case StageEnd::bound:
      return "bound";
    case StageEnd::interrupted:
      break;
  }
  return "interrupted";
}

std::optional<StageEnd> stage_end(const scene::Stage& stage, std::uint64_t steps,
                                  const automaton::StepReport& report,
                                  const StageHistory& history) {
  if (const auto* until = std::get_if<scene::UntilSteps>(&stage.until)) {
    return steps >= until->steps ? std::optional(StageEnd::steps) : std::nullopt;
  }
  const auto* discharged = std::get_if<scene::UntilDischarged>(&stage.until);
  if (discharged != nullptr && history.discharged_share() >= discharged->share) {
    return StageEnd::discharged;
  }
  if (report.settled) {
    return StageEnd::settled;
  }
  return steps >= stage.max_steps ? std::optional(StageEnd::bound) : std::nullopt;
}

double done_share(const scene::Stage& stage, std::uint64_t steps, double moving_share,
                  double most_moving, const StageHistory& history) {
  if (const auto* until = std::get_if<scene::UntilSteps>(&stage.until)) {
    return static_cast<double>(steps) / static_cast<double>(until->steps);
  }
  if (const auto* discharged = std::get_if<scene::UntilDischarged>(&stage.until)) {
    return std::min(1.0, history.discharged_share() / discharged->share);
  }
  return most_moving > 0 ? 1 - moving_share / most_moving : 0;
}

}  // namespace clca::run
