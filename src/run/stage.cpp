#include "run/stage.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "clca/scene/parse.hpp"
#include "record/internal/cycle_record.hpp"
#include "record/internal/meter.hpp"

namespace clca::run {

namespace {

void fill(model::SceneModel& model, const scene::Scene& scene, const scene::Stage& stage) {
  const scene::Fill& fill = *stage.fill;
  if (const auto mixture = scene::mixture_of(fill)) {
    const grains::FillResult result = model.grains().fill(fill.region, *mixture);
    if (std::ranges::all_of(result.placed_by_species,
                            [](std::size_t placed) { return placed == 0; })) {
      throw scene::SceneError(
          fmt::format("{}: error: the fill of stage {} has placed nothing; enlarge "
                      "the region, or raise the level",
                      fill.location, stage.name));
    }
    return;
  }
  const grains::FillResult result = model.grains().fill(
      fill.region, fill.species_counts, fill.method == scene::FillMethod::deposition);
  if (result.complete) {
    return;
  }
  std::string fitted;
  for (std::size_t species = 0; species < fill.species_counts.size(); ++species) {
    if (fill.species_counts[species] > 0) {
      fitted += fmt::format("{}{} of {} {}", fitted.empty() ? "" : ", ",
                            result.placed_by_species[species], fill.species_counts[species],
                            scene.species[species].name);
    }
  }
  throw scene::SceneError(
      fmt::format("{}: error: the fill of stage {} does not fit: {} fitted; enlarge the region, "
                  "lower the counts or fill in several stages",
                  fill.location, stage.name, fitted));
}

void insert_walls(model::SceneModel& model, const scene::Scene& scene, const scene::Stage& stage) {
  for (const std::size_t wall : stage.inserted_walls) {
    if (!model.grains().insert_wall(wall)) {
      throw scene::SceneError(fmt::format(
          "{}: error: stages.{}.insert: wall {} would stand inside particles or another wall; move "
          "it, or insert it before they come",
          stage.insert_location, stage.name, scene.walls[wall].name));
    }
  }
}

/// True if some moving wall has not finished, in a settled state.
bool has_stalled(const grains::State& state) {
  return std::ranges::any_of(state.walls, [](const grains::Wall& wall) {
    return wall.present && wall.travel.active && !grains::is_over(*wall.motion, wall.travel);
  });
}

}  // namespace

record::StageHistory prepare_stage(model::SceneModel& model, const scene::Scene& scene,
                                   std::size_t number) {
  const scene::Stage& stage = scene.stages[number];
  // Particles of another run may have been in outlets when this one took them.
  record::StageHistory history =
      number > 0 ? record::StageHistory(scene, model.state())
                 : record::StageHistory(scene, model::grains_of(model::empty_state(scene)));
  model.set_rules(stage);
  for (const std::size_t wall : stage.removed_walls) {
    model.grains().remove_wall(wall);
  }
  insert_walls(model, scene, stage);
  if (stage.fill) {
    fill(model, scene, stage);
  }
  for (std::size_t source = 0; source < scene.sources.size(); ++source) {
    model.grains().set_source_open(source, std::ranges::count(stage.open_sources, source) > 0);
  }
  for (std::size_t wall = 0; wall < scene.walls.size(); ++wall) {
    if (scene.walls[wall].motion) {
      model.grains().set_wall_moving(wall, std::ranges::count(stage.moving_walls, wall) > 0);
    }
  }
  model.set_vessel(stage);
  model.grains().reset_origins();
  return history;
}

std::string to_text(StageEnd end) {
  constexpr std::array kWords = {"settled",    "stalled", "steps", "time",
                                 "discharged", "cycles",  "bound", "interrupted"};
  return kWords.at(static_cast<std::size_t>(end));
}

std::optional<StageEnd> stage_end(const scene::Stage& stage, const grains::State& state,
                                  const record::StageHistory& history) {
  if (history.steps == 0) {
    return std::nullopt;
  }
  if (const auto steps = scene::fixed_steps(stage.until)) {
    const bool by_time = std::holds_alternative<scene::UntilTime>(stage.until);
    return history.steps >= *steps ? std::optional(by_time ? StageEnd::time : StageEnd::steps)
                                   : std::nullopt;
  }
  const auto* discharged = std::get_if<scene::UntilDischarged>(&stage.until);
  if (discharged != nullptr && history.discharged_share() >= discharged->discharged_share) {
    return StageEnd::discharged;
  }
  const auto* cycles = std::get_if<scene::UntilCycles>(&stage.until);
  if (cycles != nullptr && history.completed_cycles >= cycles->cycles) {
    return StageEnd::cycles;
  }
  if (history.is_at_rest) {
    return has_stalled(state) ? StageEnd::stalled : StageEnd::settled;
  }
  return history.steps >= stage.max_steps ? std::optional(StageEnd::bound) : std::nullopt;
}

void StageRunner::begin_stage() {
  history.begin(model->state());
  present_particles = grains::present_count(model->state());
  observers.begin_stage(view());
}

grains::StepReport StageRunner::step() {
  const record::WallClock clock;
  const grains::StepReport report = model->grains().step();
  counters.step_seconds += clock.seconds();
  history.add_step(report, model->state());
  counters.moving = report.moved_count;
  counters.stepped = present_particles + report.emitted_count;
  present_particles = counters.stepped - report.removed_count;
  counters.updates += static_cast<double>(counters.stepped);
  observers.after_step(view());
  history.completed_cycles = observers.find<record::CycleRecord>()->completed_cycles();
  return report;
}

void StageRunner::end_stage(StageEnd end) {
  history.ended_at_rest = end == StageEnd::settled || end == StageEnd::stalled;
  observers.end_stage(view());
}

std::optional<double> done_share(const scene::Stage& stage, const record::StageHistory& history) {
  if (const auto steps = scene::fixed_steps(stage.until)) {
    return static_cast<double>(history.steps) / static_cast<double>(*steps);
  }
  if (const auto* discharged = std::get_if<scene::UntilDischarged>(&stage.until)) {
    return std::min(1.0, history.discharged_share() / discharged->discharged_share);
  }
  if (const auto* cycles = std::get_if<scene::UntilCycles>(&stage.until)) {
    return static_cast<double>(history.completed_cycles) / static_cast<double>(cycles->cycles);
  }
  return std::nullopt;
}

}  // namespace clca::run
