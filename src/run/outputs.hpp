#pragma once
// Everything that a run writes but its summary: pictures, tables, the resolved scene.

#include <optional>

#include "clca/automaton/automaton.hpp"
#include "clca/scene/scene.hpp"
#include "clca/store/run_folder.hpp"
#include "run/pictures.hpp"
#include "run/records.hpp"
#include "run/series.hpp"
#include "run/stage_measures.hpp"

namespace clca::run {

class Outputs {
 public:
  /// Finds out whether the pictures can be drawn; touches no file. Throws ScenePlaceError.
  Outputs(const scene::Scene& scene, const automaton::State& state, bool last_picture_only);

  /// From here on files go to `folder`, which must outlive this object.
  void open(const store::RunFolder& folder);
  void begin_stage(const scene::Stage& stage, const automaton::Automaton& automaton,
                   const Records& records);
  void after_step(const scene::Stage& stage, const automaton::Automaton& automaton,
                  const Records& records, std::uint64_t steps_in_stage, std::size_t moving);
  /// The last picture of the stage, its tables, and those of the run so far.
  void end_stage(const scene::Stage& stage, const automaton::Automaton& automaton,
                 const Records& records, std::size_t moving, const StageHistory& history);
  /// Waits until all is written.
  void finish();

 private:
  void write_tables(const scene::Stage& stage, const automaton::Automaton& automaton,
                    const Records& records, const StageHistory& history);
  bool wants(scene::Measure measure) const;

  const scene::Scene& scene_;
  bool last_picture_only_;
  const store::RunFolder* folder_ = nullptr;
  std::optional<Pictures> pictures_;
  std::optional<SeriesTable> series_;
};

}  // namespace clca::run
