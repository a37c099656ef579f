#pragma once
// The measures that a scene asks for, taken at the end of a stage.

#include <vector>

#include "clca/grains/model.hpp"
#include "clca/measure/outflow.hpp"
#include "clca/scene/scene.hpp"
#include "clca/store/summary.hpp"
#include "run/model.hpp"
#include "run/records.hpp"

namespace clca::run {

/// What is known of a stage besides its final state.
struct StageHistory {
  StageHistory() = default;
  /// Of a stage before which so much has left as in `state`.
  StageHistory(const scene::Scene& scene, const grains::State& state);
  /// When the stage is prepared: its fill may be in outlets.
  void begin(const grains::State& state);
  /// After a step; cycles are counted elsewhere.
  void add_step(const grains::StepReport& report, const grains::State& state);

  std::vector<double> profile_at_start;  ///< measure::surface_profile
  std::size_t particles_at_start = 0;
  std::uint64_t steps = 0;
  std::uint64_t cycles = 0;  ///< of the walls that go to and fro
  std::size_t emitted = 0;
  measure::Outflow outflow = {};
  std::vector<measure::Outflow> outlets = {};           ///< the same of each
  std::vector<std::uint64_t> discharged_at_start = {};  ///< measure::discharged_particles
  bool resting = false;                                 ///< the last step has settled
  bool settled = false;                                 ///< or stalled: how the stage ended

  /// Share of the particles that were or came in during the stage that have left.
  double discharged_share() const;
  static constexpr auto fields() {
    using reflection::field;
    return std::make_tuple(
        field("profile_at_start", &StageHistory::profile_at_start),
        field("particles_at_start", &StageHistory::particles_at_start),
        field("steps", &StageHistory::steps), field("cycles", &StageHistory::cycles),
        field("emitted", &StageHistory::emitted), field("outflow", &StageHistory::outflow),
        field("outlets", &StageHistory::outlets),
        field("discharged_at_start", &StageHistory::discharged_at_start),
        field("resting", &StageHistory::resting));
  }
};

std::vector<store::NamedMeasure> stage_measures(const scene::Scene& scene, const Model& model,
                                                const StageHistory& history,
                                                const Records& records);
/// Of one measure alone, which the scene asks for.
std::vector<store::NamedMeasure> stage_measures(scene::Measure wanted, const scene::Scene& scene,
                                                const Model& model, const StageHistory& history,
                                                const Records& records);

/// Why slopes among the measures have no value where it is not plain; one line for each flank.
std::vector<std::string> slope_notes(const scene::Scene& scene, const Model& model);

/// Columns fallen_d (mean diameters), fallen (mean of the pairs, lattice spacings), pairs, kept,
/// pair_diffusion (lattice spacings); see measure::FallenPairs.
std::string mixing_table(const measure::Mixing& mixing);

/// Columns x, height_start, height_end: lattice spacings, one line per lattice column.
std::string profile_table(const std::vector<double>& start, const std::vector<double>& end);

}  // namespace clca::run
