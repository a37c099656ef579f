#pragma once
// How a stage begins and when it ends.

#include <cstdint>
#include <optional>
#include <string>

#include "clca/automaton/automaton.hpp"
#include "clca/scene/scene.hpp"
#include "run/stage_measures.hpp"

namespace clca::run {

/// Fills, removes walls, opens and closes sources, marks the origins. Throws ScenePlaceError when
/// the fill does not fit.
void prepare_stage(automaton::Automaton& automaton, const scene::Scene& scene,
                   const scene::Stage& stage);

/// Why a stage has ended.
enum class StageEnd : std::uint8_t { settled, steps, discharged, bound, interrupted };

/// As written in run.json.
std::string to_text(StageEnd end);

/// Why the stage ends after `steps` steps, the last of which gave `report`; nothing: it goes on.
std::optional<StageEnd> stage_end(const scene::Stage& stage, std::uint64_t steps,
                                  const automaton::StepReport& report, const StageHistory& history);

/// How much of the stage is done, in [0, 1], guessed from the share of particles that move: from
/// `most_moving` at its height down to nobody.
double done_share(const scene::Stage& stage, std::uint64_t steps, double moving_share,
                  double most_moving, const StageHistory& history);

}  // namespace clca::run
