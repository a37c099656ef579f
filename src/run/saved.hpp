#pragma once
// What a run of grains keeps in its checkpoint, besides its records and outputs.

#include "clca/run/run.hpp"
#include "clca/store/file.hpp"
#include "run/model.hpp"
#include "run/outputs.hpp"
#include "run/stage_measures.hpp"

namespace clca::run {

/// How far a run has come.
struct RunCourse {
  std::uint64_t stage = 0;   ///< that it is in, from 0
  std::uint64_t moving = 0;  ///< particles, in the last step
  double updates = 0;        ///< particles x steps
  double wall_seconds = 0;
  double step_seconds = 0;
  std::uint64_t log_bytes = 0;

  static constexpr auto fields() {
    using fields::field;
    return std::make_tuple(
        field("stage", &RunCourse::stage), field("moving", &RunCourse::moving),
        field("updates", &RunCourse::updates), field("wall_seconds", &RunCourse::wall_seconds),
        field("step_seconds", &RunCourse::step_seconds), field("log_bytes", &RunCourse::log_bytes));
  }
};

inline constexpr const char* kSavedCourse = "course";
inline constexpr const char* kSavedHistory = "stage";
inline constexpr const char* kSavedOutputs = "outputs";

/// What of a checkpoint is not left to records.
struct SavedParts {
  ModelState state;
  RunCourse course;
  StageHistory history;
  OutputHistory outputs;
  std::vector<store::StageSummary> stages;  ///< those that have ended
};

/// Throws fields::Mismatch or std::invalid_argument for what no run of the scene can have saved.
SavedParts saved_parts(const scene::Scene& scene, const SavedRun& saved);

/// What is wrong with a checkpoint, as an error of its folder.
store::StoreError not_of_this_run(const std::filesystem::path& folder, const std::string& reason);

}  // namespace clca::run
