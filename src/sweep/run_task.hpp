#pragma once
// One run of a sweep, new or of an earlier sweep.

#include <atomic>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "clca/run/run.hpp"
#include "clca/scene/scene.hpp"
#include "clca/store/summary.hpp"
#include "clca/sweep/sweep.hpp"
#include "clca/tasks/ranks.hpp"
#include "sweep/tables.hpp"

namespace clca::sweep {

inline constexpr const char* kRunsFolder = "runs";

/// The folder of a run in the folder of a sweep.
inline std::filesystem::path run_folder(const std::filesystem::path& sweep,
                                        const std::string& name) {
  return sweep / kRunsFolder / name;
}

/// A run that was once done.
struct EarlierRun {
  store::RunSummary summary;
  /// It is of exactly this scene and program version, and has the pictures that are wanted.
  bool is_whole = false;
};

/// The run in `folder`, if one was done there.
std::optional<EarlierRun> earlier_run(const std::filesystem::path& folder,
                                      const scene::Scene& scene, run::WantedPictures pictures);

/// How a run has ended.
struct RunOutcome {
  Result result;
  std::vector<std::string> warnings;
  std::string store_error;  ///< something could not be written; empty: all was
  bool is_in_use = false;   ///< another process is at work on it

  CLCA_FIELDS(result, warnings, store_error, is_in_use);
};

/// Executes a run in its folder, or goes on with it where it was stopped or killed. `progress` may
/// be empty.
RunOutcome execute_run(const scene::Scene& scene, const std::filesystem::path& folder,
                       const Options& options, run::WantedPictures pictures,
                       const std::atomic<int>* stop,
                       std::function<void(const run::Progress&)> progress);

/// From one process to another.
tasks::Bytes to_bytes(const RunOutcome& run);
RunOutcome run_outcome(const tasks::Bytes& bytes);

}  // namespace clca::sweep
