#pragma once
// How a stage begins and when it ends.

#include <cstdint>
#include <optional>
#include <string>

#include "clca/scene/scene.hpp"
#include "run/model.hpp"
#include "run/observer.hpp"

namespace clca::run {

/// Removes and inserts walls, fills, opens and closes sources, starts walls and the vessel, marks
/// the origins.
/// Throws SceneRunError if a wall would overlap particles or the fill does not fit.
void prepare_stage(SceneModel& model, const scene::Scene& scene, const scene::Stage& stage);

/// Why a stage has ended. `stalled`: settled, with a wall that is due to move and blocked.
enum class StageEnd : std::uint8_t {
  settled,
  stalled,
  steps,
  time,
  discharged,
  cycles,
  bound,
  interrupted
};

/// As written in run.json.
std::string to_text(StageEnd end);

/// Why the stage ends now; none if it continues.
std::optional<StageEnd> stage_end(const scene::Stage& stage, const grains::State& state,
                                  const StageHistory& history);

/// Progress of the stage in [0, 1]; none of one until rest: nobody knows how long that takes.
std::optional<double> done_share(const scene::Stage& stage, const StageHistory& history);

}  // namespace clca::run
