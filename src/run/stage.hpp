#pragma once
// How a run and its stages begin, go on and end.

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "clca/scene/scene.hpp"
#include "model/internal/scene_model.hpp"
#include "record/internal/observer.hpp"
#include "run/saved.hpp"

namespace clca::run {

/// The state before the first step. If the scene begins with another run, it has the particles of
/// that, numbered anew in their order; grains of the contact model keep velocities, contacts and
/// positions within their sites if they come from the end of a run of that model, else they are at
/// rest. Throws scene::SceneError unless they are there, of species of the scene, and find room.
model::ModelState state_at_start(const scene::Scene& scene);

/// Removes and inserts walls, fills, opens and closes sources, starts walls and the vessel, marks
/// the origins. The history counts what has left before: the fill may be in outlets.
/// Throws scene::SceneError if a wall would overlap particles or the fill does not fit.
record::StageHistory prepare_stage(model::SceneModel& model, const scene::Scene& scene,
                                   std::size_t number);

/// Why a stage has ended. `stalled`: settled, with a wall that is due to move and blocked.
enum class StageEnd : std::uint8_t {
  settled,
  stalled,
  steps,
  time,
  discharged,
  cycles,
  bound,  ///< max_steps, before the stage has ended otherwise
  interrupted
};

std::string to_text(StageEnd end);

/// Why the stage ends now; none if it continues.
std::optional<StageEnd> stage_end(const scene::Stage& stage, const grains::State& state,
                                  const record::StageHistory& history);

/// A scene of grains on its way through its stages, with what observes it.
struct StageRunner {
  const scene::Scene& scene;
  model::SceneModel* model;
  record::Observers observers;
  const store::OutputFolder* files = nullptr;  ///< as StageView::output_folder
  std::function<void(const std::string& line)> warn = [](const std::string& /*line*/) {};
  RunCounters counters = {};
  record::StageHistory history = {};
  std::size_t present_particles = 0;  ///< particles in the box

  const scene::Stage& stage() const { return scene.stages[counters.stage]; }
  record::StageView view() const {
    return {scene,           stage(),          *model, history, observers,
            counters.moving, counters.stepped, files,  warn};
  }
  void begin_stage();  ///< begins a stage that prepare_stage() has prepared
  grains::StepReport step();
  void end_stage(StageEnd end);
};

/// Progress of the stage in [0, 1]; none for a stage until rest, whose length is unknown.
std::optional<double> done_share(const scene::Stage& stage, const record::StageHistory& history);

}  // namespace clca::run
