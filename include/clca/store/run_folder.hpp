#pragma once
// The folder of a run.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "clca/store/checkpoint.hpp"
#include "clca/store/output_folder.hpp"
#include "clca/store/summary.hpp"

namespace clca::store {

/// Name of the picture of a step: `NAME-000120.png`, for 6 `digits`.
std::string frame_name(const std::string& scene, std::uint64_t step, int digits,
                       std::string_view ending = ".png");
/// Picture of a step in the run folder `run`: `frames/NAME-000120.png`.
std::filesystem::path frame_path(const std::filesystem::path& run, const std::string& scene,
                                 std::uint64_t step, int digits);

// Names in a run folder.
inline constexpr const char* kSceneFile = "scene.yaml";
inline constexpr const char* kSummaryFile = "run.json";
inline constexpr const char* kCalibrationFile = "calibration.json";  ///< of the Python package
inline constexpr const char* kLogFile = "log.txt";
inline constexpr const char* kFramesFolder = "frames";
inline constexpr const char* kRedrawnFolder = "render";  ///< pictures that are drawn again
inline constexpr const char* kPlotsFolder = "plots";
inline constexpr const char* kExportFolder = "export";

/// A table of the whole run, `series.csv`, or of one stage, `profile-STAGE.csv`.
std::string table_name(std::string_view kind, const std::string& stage = "");

/// The summary of a run that is done; none if it is not done, or the summary cannot be read.
std::optional<RunSummary> finished_summary(const std::filesystem::path& run_folder);

struct EarlierRun {
  RunSummary summary;
  std::string written_at;     ///< local time at which run.json was written; empty where it was not
  bool is_resumable = false;  ///< it is not done and may go on from a checkpoint
};

/// A run folder, locked for other runs while this object exists.
class RunFolder {
 public:
  /// For a new run. Makes the folder if needed and changes nothing in it. Throws StoreError, also
  /// if another run is active there, or something else is there than a run.
  static RunFolder for_new_run(const std::filesystem::path& path);
  /// For a resumed run. Throws StoreError, also if no run has started there.
  static RunFolder for_resumed_run(const std::filesystem::path& path);

  std::filesystem::path path() const { return folder_.path(); }
  const OutputFolder& output_folder() const { return folder_; }

  /// None if clca has written nothing there. Throws StoreError if neither run.json nor a checkpoint
  /// can be read.
  std::optional<EarlierRun> earlier_run() const;

  /// Replaces the checkpoint by `start`, then removes all else that clca has written there. May be
  /// repeated until it succeeds.
  void start_over(const Checkpoint& start) const;
  /// Removes the pictures of steps after `last_step`; all if none.
  void remove_frames_after(std::optional<std::uint64_t> last_step) const;

 private:
  RunFolder(const std::filesystem::path& path, FolderLock lock);

  FolderLock lock_;
  OutputFolder folder_;
};

}  // namespace clca::store
