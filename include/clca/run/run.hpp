#pragma once
// Runs a scene from its first stage to its last and leaves a run folder.

#include <atomic>
#include <chrono>
#include <filesystem>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>

#include "clca/scene/parse.hpp"
#include "clca/store/checkpoint.hpp"
#include "clca/store/run_folder.hpp"
#include "clca/store/summary.hpp"

namespace clca::run {

/// A scene that cannot be run as it stands: a fill that does not fit, a picture that the driver
/// cannot draw. what() is one line with the place in the scene file.
class ScenePlaceError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// How a run is going.
struct Progress {
  std::string stage;
  std::size_t stage_number = 0;  ///< from 1
  std::size_t stage_count = 0;
  std::uint64_t step = 0;
  std::string time;  ///< with its unit; empty where steps have no length
  std::size_t particles = 0;
  double moving_share = 0;        ///< of the particles, in the last step
  double updates_per_second = 0;  ///< particles x steps / time in steps
  /// Seconds to the end of the stage, a guess; none while nothing can be said.
  std::optional<double> seconds_left;
};

/// How a run of the Boltzmann equation is going.
struct GasProgress {
  std::string stage;
  std::size_t stage_number = 0;  ///< from 1
  std::size_t stage_count = 0;
  double time = 0;  ///< of one gas of the ensemble
  double until = 0;
  std::uint64_t gases_done = 0;  ///< of this stage
  std::uint64_t gases = 0;
  double collisions_per_second = 0;  ///< of pairs
  std::optional<double> seconds_left;
};

struct RunOptions {
  std::filesystem::path folder = {};
  int threads = 1;
  /// Steps as the model is defined, not as they are fast; of the contact model.
  bool reference = false;
  /// Looked at once a step: when it is not zero the run saves itself and ends with what it has,
  /// written whole.
  const std::atomic<int>* stop = nullptr;
  /// Seconds by the clock after which the run stops in the same way.
  std::optional<double> time_limit = {};
  /// Draws no picture but that of the final state, whatever the scene says of `every`.
  bool last_picture_only = false;
  /// Replaces a run in the folder that was interrupted, too.
  bool overwrite = false;
  /// Leaves what is in the folder alone: runs in the first of FOLDER, FOLDER-2, ... that is not
  /// there.
  bool keep = false;
};

/// A run that was interrupted is in the way of a new one. what() is one line with the folder.
class UnfinishedRunError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// All optional; called from the thread that runs.
struct RunEvents {
  std::function<void(const Progress&)> progress = {};
  std::function<void(const GasProgress&)> gas_progress = {};
  /// Least time between two calls of one of these; they come after a step.
  std::chrono::milliseconds progress_interval{100};
  /// The folder of the run, when it has been chosen.
  std::function<void(const std::filesystem::path&)> folder = {};
  std::function<void(const std::string&)> message = {};
  std::function<void(const std::string&)> warning = {};
};

/// Replaces what an earlier run has left in the folder; other files stay as they are. Throws
/// scene::SceneError (see check_walls and check_room), ScenePlaceError, UnfinishedRunError,
/// store::StoreError, or std::bad_alloc; std::invalid_argument for a number of threads that is not
/// positive. Where fewer threads can be started it warns and goes on with these. What fails after
/// the folder was made leaves `failed` in it, and the last checkpoint to be gone on with. Several
/// threads may run at once, each into a folder of its own. No folder is made for a scene whose
/// first stage cannot begin.
store::RunSummary run(const scene::Scene& scene, const RunOptions& options,
                      const RunEvents& events = {});

/// As the other, for the Boltzmann equation: an ensemble for each restitution.
store::RunSummary run(const scene::BoltzmannScene& scene, const RunOptions& options,
                      const RunEvents& events = {});

/// A run that was stopped or killed, or has ended, as it was when it last saved itself. Nobody else
/// runs in its folder while this is there.
struct SavedRun {
  store::RunFolder folder;
  scene::AnyScene scene;
  store::Checkpoint checkpoint;
  std::optional<store::RunSummary> finished;  ///< there is nothing to go on with: its summary
  double most_bytes = 0;                      ///< that loading it may take
  std::optional<std::string> until;  ///< the end that was asked for in place of the scene's
  std::string warning;               ///< one line where the newest checkpoint could not be used
};

/// Loads what `folder` has saved. With `until`, in the words of a scene, the run goes on as if its
/// scene had said so from the beginning: that of the last stage (a plain number: steps), or the
/// time of a gas. Throws store::StoreError where there is nothing to go on from, or no checkpoint
/// that may be read with `most_bytes` of memory; scene::SceneError for a wrong `until`. Changes
/// nothing in the folder.
SavedRun load_run(const std::filesystem::path& folder, double most_bytes,
                  const std::optional<std::string>& until = {});

/// Goes on to the end that the scene asks for: the same bits as those of a run that was never
/// stopped. The folder of the options is not used. Throws as run() does, and ScenePlaceError for an
/// `until` that the run has passed.
store::RunSummary resume(SavedRun saved, const RunOptions& options, const RunEvents& events = {});

/// A summary with version, compiler and build type filled in.
store::RunSummary provenance();

/// Version of the program, as in CMakeLists.txt.
std::string version();

}  // namespace clca::run
