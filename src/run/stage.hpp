#pragma once
// How a stage begins and when it ends.

#include <cstdint>
#include <optional>
#include <string>

#include "clca/scene/scene.hpp"
#include "run/model.hpp"
#include "run/stage_measures.hpp"

namespace clca::run {

/// Removes and inserts walls, fills, opens and closes sources, sets walls and the vessel in
/// motion, marks the origins. Throws ScenePlaceError when a wall would stand inside particles or
/// the fill does not fit.
void prepare_stage(Model& model, const scene::Scene& scene, const scene::Stage& stage);

/// Why a stage has ended.
/// `stalled`: settled with a wall that wants to move and cannot.
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

/// Why the stage ends after the steps it has taken; nothing: it goes on.
std::optional<StageEnd> stage_end(const scene::Stage& stage, const grains::State& state,
                                  const StageHistory& history);

/// How much of the stage is done, in [0, 1], guessed from the share of particles that move: from
/// `most_moving` at its height down to nobody.
double done_share(const scene::Stage& stage, const StageHistory& history, double moving_share,
                  double most_moving);

}  // namespace clca::run
