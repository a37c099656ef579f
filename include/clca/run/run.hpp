#pragma once
// Runs all stages of a scene and writes a run folder.

#include <atomic>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "clca/scene/parse.hpp"
#include "clca/store/checkpoint.hpp"
#include "clca/store/run_folder.hpp"
#include "clca/store/summary.hpp"
#include "clca/tasks/ranks.hpp"
#include "clca/text/read.hpp"

namespace clca::run {

struct Progress {
  std::string stage;
  std::size_t stage_number = 0;  ///< from 1
  std::size_t stage_count = 0;
  std::uint64_t step = 0;
  std::string time_text;  ///< with its unit; empty where steps have no length
  std::size_t particles = 0;
  double moving_share = 0;                 ///< of the particles, in the last step
  double particle_updates_per_second = 0;  ///< particles x steps / time in steps
  bool ends_at_rest = false;               ///< the stage ends at rest: nobody knows when
  std::optional<double> seconds_left;      ///< estimated seconds to the end of the stage, if known
};

struct GasProgress {
  std::string stage;
  std::size_t stage_number = 0;  ///< from 1
  std::size_t stage_count = 0;
  double time = 0;  ///< of one gas of the ensemble
  double end_time = 0;
  std::uint64_t done_gases = 0;  ///< of this stage
  std::uint64_t gas_count = 0;
  double collisions_per_second = 0;  ///< of pairs
  std::optional<double> seconds_left;
};

/// All pictures of a scene, only that of the final state, or none.
enum class WantedPictures : std::uint8_t { all, last, none };

struct RunOptions {
  std::filesystem::path folder = {};
  int threads = 1;
  /// Uses the reference step of the model instead of the fast engine.
  bool use_reference_step = false;
  /// Least number of particles for a step by several threads; none: chosen by speed. For tests.
  std::optional<std::size_t> parallel_from = {};
  /// Checked once per step: if not zero, the run saves a checkpoint and ends with complete files.
  const std::atomic<int>* stop_signal = nullptr;
  /// Wall-clock seconds after which the run stops in the same way.
  std::optional<double> wall_seconds_limit = {};
  WantedPictures pictures = WantedPictures::all;
  bool replace_interrupted = false;
  /// Keeps an existing folder: uses the first of FOLDER, FOLDER-2, ... that does not exist.
  bool keep_earlier_run = false;
  /// Processes among which the gases of an ensemble are divided; the caller is rank 0 and has to
  /// dismiss the others afterwards. A run of grains is the work of one process.
  tasks::Ranks* ranks = nullptr;
};

/// The folder holds an interrupted run. what() is one line with the folder.
class UnfinishedRunError : public text::InputError {
 public:
  using InputError::InputError;
};

/// All optional; called from the thread that runs.
struct RunEvents {
  std::function<void(const Progress&)> progress = {};
  std::function<void(const GasProgress&)> gas_progress = {};
  /// Shortest time between two progress calls, which come after a step.
  std::chrono::milliseconds progress_interval{100};
  std::function<void(const std::filesystem::path&)> folder_known = {};
  std::function<void(const std::string&)> message = {};
  /// Other news: stages that begin and, in runs of grains, checkpoints.
  std::function<void(const std::string&)> detail = {};
  std::function<void(const std::string&)> warning = {};
};

/// Runs a scene. Replaces the files of an earlier run in the folder; other files stay. No folder is
/// made if the first stage cannot start. Several threads may run at once, each in its own folder.
/// Throws scene::SceneError, also for a fill that does not fit and a picture that the driver cannot
/// draw; UnfinishedRunError, store::StoreError, std::bad_alloc; std::invalid_argument unless the
/// number of threads is positive.
/// If fewer threads can be started, warns and uses these. A later failure leaves the status
/// `failed` and the last checkpoint.
store::RunSummary run(const scene::Scene& scene, const RunOptions& options,
                      const RunEvents& events = {});

/// Runs a scene of the Boltzmann equation, an ensemble for each restitution; else as run() above.
store::RunSummary run(const scene::BoltzmannScene& scene, const RunOptions& options,
                      const RunEvents& events = {});

/// Advances a share of the gases of a Boltzmann run. The ranks other than 0 call it in place of
/// run() or resume(). Like these, throws tasks::StartError if the ranks cannot begin together.
void work_for_rank_0(const RunOptions& options);

/// A stopped, killed or finished run at its last checkpoint. This object locks the folder.
struct SavedRun {
  store::RunFolder folder;
  scene::AnyScene scene = {};
  store::Checkpoint checkpoint = {};
  std::optional<store::RunSummary> finished_summary = {};  ///< of a run that is done
  double max_bytes = 0;                                    ///< memory limit for loading it
  std::optional<std::string> new_end = {};  ///< requested end in place of the scene's
  std::string warning = {};                 ///< one line if the newest checkpoint could not be used
};

/// Loads the checkpoint in `folder`. Changes nothing there.
/// `until`, in the syntax of a scene, replaces the end of the last stage (a plain number: steps) or
/// the end time of a gas, as if the scene had said so from the start.
/// Throws store::StoreError if there is no checkpoint that fits into `max_bytes` of memory,
/// scene::SceneError for a wrong `until`.
SavedRun load_run(const std::filesystem::path& folder, double max_bytes,
                  const std::optional<std::string>& until = {});

/// Which pictures a saved run draws; `all` if it begins with its first step. Throws
/// reflection::ColumnMismatch.
WantedPictures wanted_pictures_of(const SavedRun& saved);

/// Continues a run to its end, with the same bits as an uninterrupted run. Ignores the folder of
/// the options.
/// Throws as run(), store::UnusableCheckpointError, and scene::SceneError for an `until` that the
/// run has passed.
store::RunSummary resume(SavedRun saved, const RunOptions& options, const RunEvents& events = {});

}  // namespace clca::run
