#include "run/saved.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "clca/run/setup.hpp"
#include "clca/text/message.hpp"
#include "clca/text/read.hpp"
#include "run/stage.hpp"

namespace clca::run {

namespace {

/// The saved scene with another end, and with a bound of steps that is not below it.
scene::AnyScene scene_with_new_end(const scene::AnyScene& saved, const std::string& text,
                                   const std::string& file, const std::string& until) {
  const std::string option = "--until " + until;
  const auto* automaton = std::get_if<scene::Scene>(&saved);
  if (automaton == nullptr) {
    return scene::parse_any(text, file, {{"boltzmann.until=" + until, option}});
  }
  const std::string stage = fmt::format("stages.{}.", automaton->stages.size() - 1);
  const bool plain = !until.empty() && until.find_first_not_of("0123456789") == std::string::npos;
  const auto with_bound = [&](std::uint64_t max_steps) {
    return scene::parse(
        text, file,
        {{stage + "until=" + (plain ? fmt::format("{{steps: {}}}", until) : until), option},
         fmt::format("{}max_steps={}", stage, max_steps)});
  };
  const scene::Scene longer = with_bound(scene::kMaxSteps);
  return with_bound(std::max(automaton->stages.back().max_steps,
                             scene::least_steps(longer.stages.back(), longer)));
}

/// Whether a run that reached `now` can have recorded this history of what has left.
bool is_possible_outflow(const record::StageHistory& history, const grains::State& now,
                         std::size_t species) {
  return history.outflow.precedes(measure::discharge(now)) &&
         std::equal(history.outlets.begin(), history.outlets.end(), now.outlets.begin(),
                    now.outlets.end(),
                    [](const measure::Outflow& outflow, const grains::Outlet& outlet) {
                      return outflow.precedes(measure::discharge(outlet));
                    }) &&
         std::ranges::equal(history.discharged_at_start, measure::discharged_counts(now, species),
                            std::less_equal<>());
}

/// Checks a new end of the last stage, and raises the bound of the stage if that has ended it.
/// Throws scene::SceneError for an end that the stage has met before.
void accept_new_end(const std::string& until, scene::Stage& stage, const grains::State& state,
                    const record::StageHistory& history) {
  if (stage_end(stage, state, history) == StageEnd::bound) {
    stage.max_steps = std::min(history.steps + scene::Stage().max_steps, scene::kMaxSteps);
  }
  if (stage_end(stage, state, history) && scene::fixed_steps(stage.until) != history.steps) {
    throw scene::SceneError(
        fmt::format("--until {}: error: stage {} has passed this end: it is at step {}",
                    text::shortened(until), stage.name, history.steps));
  }
}

}  // namespace

SavedRun load_run(const std::filesystem::path& folder, double max_bytes,
                  const std::optional<std::string>& until) {
  SavedRun run = {.folder = store::RunFolder::for_resumed_run(folder),
                  .max_bytes = max_bytes,
                  .new_end = until};
  run.finished_summary = until ? std::nullopt : store::finished_summary(run.folder.path());
  std::optional<store::FoundCheckpoint> found;
  try {
    found = store::read_checkpoint(folder, max_bytes);
  } catch (const store::StoreError&) {
    if (!run.finished_summary) {  // else it is older and damaged: it is not needed
      throw;
    }
  }
  const bool begins_anew = found && found->checkpoint.is_before_first_step();
  if (run.finished_summary && !begins_anew) {
    return run;
  }
  run.finished_summary.reset();
  if (!found) {
    throw store::StoreError(
        fmt::format("cannot resume the run in {}: it has no checkpoint; a run with "
                    "output.checkpoint: none keeps none",
                    folder.string()));
  }
  run.checkpoint = std::move(found->checkpoint);
  run.warning = std::move(found->warning);
  const std::string& name = run.checkpoint.scene_name;
  if (!text::is_file_name(name)) {
    throw store::StoreError(
        fmt::format("cannot resume the run in {}: '{}' cannot name a file", folder.string(), name));
  }
  const std::string file = (folder / store::kSceneFile).string();
  run.scene = scene::parse_any(run.checkpoint.scene_text, file);
  if (until) {
    run.scene = scene_with_new_end(run.scene, run.checkpoint.scene_text, file, *until);
  }
  std::visit([&](auto& held) { held.name = name; }, run.scene);
  return run;
}

store::UnusableCheckpointError mismatched_checkpoint(const std::filesystem::path& folder,
                                                     const std::string& reason) {
  store::UnusableCheckpointError error(
      fmt::format("cannot resume the run in {}: its checkpoint is not of this run: {}",
                  folder.string(), reason));
  return error;
}

WantedPictures wanted_pictures_of(const SavedRun& saved) {
  const reflection::Columns& columns = saved.checkpoint.fields;
  const bool is_start = saved.checkpoint.is_before_first_step();
  WantedPictures pictures = WantedPictures::all;
  if (!is_start || !columns.empty()) {
    reflection::decode(is_start ? kRequestedPicturesPath : kPicturesPath, columns, saved.max_bytes,
                       pictures);
  }
  return pictures;
}

SavedParts saved_parts(SavedRun& saved) {
  auto& scene = std::get<scene::Scene>(saved.scene);
  SavedParts parts = {
      .state = model::state_from_checkpoint(scene, saved.checkpoint.fields, saved.max_bytes)};
  const reflection::Columns& columns = saved.checkpoint.fields;
  reflection::decode(kCountersPath, columns, saved.max_bytes, parts.counters);
  reflection::decode(kStageHistoryPath, columns, saved.max_bytes, parts.history);
  parts.ended_stages = store::parse_summary(saved.checkpoint.summary_json, "its summary").stages;
  const grains::State& grains = model::grains_of(parts.state);
  const auto columns_of_lattice = static_cast<std::size_t>(grains.lattice.columns());
  if (!is_possible_outflow(parts.history, grains, scene.species.size())) {
    throw reflection::ColumnMismatch(
        "the numbers of discharged particles do not belong to this run");
  }
  if (parts.counters.stage >= scene.stages.size() ||
      parts.ended_stages.size() != parts.counters.stage ||
      parts.history.profile_at_start.size() != columns_of_lattice) {
    throw reflection::ColumnMismatch("its stages differ from those of the scene");
  }
  if (saved.new_end && parts.counters.stage + 1 == scene.stages.size() &&
      (scene::to_yaml(scene) != saved.checkpoint.scene_text ||
       stage_end(scene.stages.back(), grains, parts.history) == StageEnd::bound)) {
    accept_new_end(*saved.new_end, scene.stages.back(), grains, parts.history);
  }
  return parts;
}

}  // namespace clca::run
