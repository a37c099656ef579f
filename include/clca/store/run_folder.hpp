#pragma once
// The folder that a run leaves.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "clca/store/folder_lock.hpp"

namespace clca::store {

/// Name of the picture of a step: `NAME-000120.png`.
std::string frame_name(const std::string& scene, std::uint64_t step);
/// Picture of a step in the run folder `run`: `frames/NAME-000120.png`.
std::filesystem::path frame_path(const std::filesystem::path& run, const std::string& scene,
                                 std::uint64_t step);

/// Folder in the run folder `run` for pictures that are drawn again: `render`.
std::filesystem::path redrawn_folder(const std::filesystem::path& run);

/// Whose folder it is as long as this object lives: nobody else writes to it meanwhile.
class RunFolder {
 public:
  /// For a new run. Makes the folder if need be. Where a run.json says that a run has been here
  /// before, clears what it has left: its pictures, also those drawn again, tables, figures,
  /// exports, checkpoints, scene.yaml, run.json, log.txt and report.html. Other files stay. Throws
  /// StoreError, also when another run is at work in the folder.
  static RunFolder for_new_run(std::filesystem::path path);
  /// For a run that goes on: clears nothing. Throws StoreError likewise.
  static RunFolder for_resumed_run(std::filesystem::path path);

  /// For a run that begins anew: removes what for_new_run() removes but scene.yaml and run.json,
  /// which say what is to be run.
  void clear_results() const;

  const std::filesystem::path& path() const { return path_; }
  /// Makes the folder of pictures if need be. Throws StoreError.
  void make_frames() const;
  /// Removes the pictures of steps after `last_step`; all of them where it is none.
  void remove_frames_after(std::optional<std::uint64_t> last_step) const;
  std::filesystem::path frame(const std::string& scene, std::uint64_t step) const {
    return frame_path(path_, scene, step);
  }

  std::filesystem::path scene() const { return path_ / "scene.yaml"; }
  std::filesystem::path summary() const { return path_ / "run.json"; }
  std::filesystem::path log() const { return path_ / "log.txt"; }
  /// A table of the whole run: `series.csv`.
  std::filesystem::path table(const std::string& kind) const { return path_ / (kind + ".csv"); }
  /// A table of one stage: `profile-STAGE.csv`.
  std::filesystem::path table(const std::string& kind, const std::string& stage) const {
    return path_ / (kind + "-" + stage + ".csv");
  }

 private:
  explicit RunFolder(std::filesystem::path path);
  std::filesystem::path frames() const { return path_ / "frames"; }

  std::filesystem::path path_;
  FolderLock lock_;
};

}  // namespace clca::store
