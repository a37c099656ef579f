#pragma once
// The folder that a run leaves.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "clca/store/checkpoint.hpp"
#include "clca/store/folder_lock.hpp"
#include "clca/store/output_folder.hpp"
#include "clca/store/summary.hpp"

namespace clca::store {

/// Name of the picture of a step: `NAME-000120.png`.
std::string frame_name(const std::string& scene, std::uint64_t step);
/// Picture of a step in the run folder `run`: `frames/NAME-000120.png`.
std::filesystem::path frame_path(const std::filesystem::path& run, const std::string& scene,
                                 std::uint64_t step);

// Names in a run folder.
inline constexpr const char* kSceneFile = "scene.yaml";
inline constexpr const char* kSummaryFile = "run.json";
inline constexpr const char* kLogFile = "log.txt";
inline constexpr const char* kFramesFolder = "frames";
inline constexpr const char* kRedrawnFolder = "render";  ///< pictures that are drawn again
inline constexpr const char* kPlotsFolder = "plots";
inline constexpr const char* kExportFolder = "export";

/// A table of the whole run, `series.csv`, or of one stage, `profile-STAGE.csv`.
std::string table_name(const std::string& kind);
std::string table_name(const std::string& kind, const std::string& stage);

/// What lies in a folder from an earlier run.
struct EarlierRun {
  RunSummary summary;
  std::string when;         ///< local time at which run.json was written; empty where it was not
  bool unfinished = false;  ///< it is not done and may go on from a checkpoint
};

/// A folder of one run at a time: nobody else runs in it as long as this object lives.
class RunFolder {
 public:
  /// For a new run. Makes the folder if need be and changes nothing in it. Throws StoreError, also
  /// when another run is at work in it or clca has written something else than a run there.
  static RunFolder for_new_run(const std::filesystem::path& path);
  /// For a run that goes on. Throws StoreError, also where no run has begun.
  static RunFolder for_resumed_run(const std::filesystem::path& path);

  const std::filesystem::path& path() const { return path_; }
  const OutputFolder& files() const { return files_; }

  /// Nothing where clca has written nothing. Throws StoreError where neither run.json nor a
  /// checkpoint of an earlier run can be read.
  std::optional<EarlierRun> earlier_run() const;

  /// Begins a run: once `start` has replaced the checkpoint, the earlier run is no more, and
  /// clear_results() may be repeated until it has succeeded.
  void start_over(const Checkpoint& start) const;
  /// Removes everything that clca has written into the folder but the newest checkpoint.
  void clear_results() const;
  /// Removes the pictures of steps after `last_step`; all of them where it is none.
  void remove_frames_after(std::optional<std::uint64_t> last_step) const;

 private:
  RunFolder(const std::filesystem::path& path, FolderLock lock);

  std::filesystem::path path_;
  FolderLock lock_;
  OutputFolder files_;
};

}  // namespace clca::store
