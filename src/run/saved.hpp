#pragma once
// The content of checkpoints; of runs of grains without that of observers.

#include "clca/run/run.hpp"
#include "clca/store/file.hpp"
#include "model/internal/scene_model.hpp"
#include "record/internal/gas_tables.hpp"
#include "record/internal/observer.hpp"

namespace clca::run {

/// Progress of a run of grains, as checkpoints have it.
struct RunCounters {
  std::uint64_t stage = 0;    ///< present stage, from 0
  std::uint64_t moving = 0;   ///< particles that moved in the last step
  std::uint64_t stepped = 0;  ///< StageView::stepped_particles
  double updates = 0;         ///< particles x steps
  double wall_seconds = 0;
  double step_seconds = 0;
  std::uint64_t log_bytes = 0;

  CLCA_FIELDS(stage, moving, stepped, updates, wall_seconds, step_seconds, log_bytes);
};

// Paths in a checkpoint.
inline constexpr const char* kCountersPath = "course";
inline constexpr const char* kStageHistoryPath = "stage";
/// Paths of the wanted pictures: in a checkpoint before the first step, and in later ones.
inline const std::string kRequestedPicturesPath =
    std::string(store::Checkpoint::kRequestPrefix) + "/pictures";
inline constexpr const char* kPicturesPath = "outputs/wanted_pictures";

/// The parts of a checkpoint that are not of observers.
struct SavedParts {
  model::ModelState state;
  RunCounters counters = {};
  record::StageHistory history = {};
  std::vector<store::StageSummary> ended_stages = {};  ///< those that have ended
};

/// May raise the bound of the last stage of `saved`. Throws reflection::ColumnMismatch or
/// std::invalid_argument if no run of the scene can have saved it, scene::SceneError for an end
/// that it has passed.
SavedParts saved_parts(SavedRun& saved);

store::UnusableCheckpointError mismatched_checkpoint(const std::filesystem::path& folder,
                                                     const std::string& reason);

struct SavedGasRun {
  std::uint64_t cases_ended = 0;  ///< those that log.txt has already
  double wall_seconds = 0;
  std::uint64_t log_bytes = 0;
  std::vector<record::GasCase> cases;  ///< all that have begun, in the order of the scene

  CLCA_FIELDS(cases_ended, wall_seconds, log_bytes, cases);
};

/// As resume(), for a scene of the Boltzmann equation.
store::RunSummary resume_gas(SavedRun& saved, const RunOptions& options, const RunEvents& events);

inline constexpr const char* kGasesPath = "gases";

/// Loads the checkpoint for resuming with its scene. Gases at or on the way to a previous end go
/// back to the last time shared with the new one.
/// Throws store::StoreError for a checkpoint that no run of the scene can have saved, and for an
/// end that it cannot continue to.
SavedGasRun saved_gas_run(const SavedRun& saved);

}  // namespace clca::run
