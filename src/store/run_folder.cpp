#include "clca/store/run_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <string_view>
#include <system_error>
#include <vector>

#include "clca/store/file.hpp"
#include "store/trajectory_files.hpp"

namespace clca::store {

namespace {

namespace fs = std::filesystem;

/// Calls `act` with an error code and turns a failure into a StoreError.
template <class Act>
void checked(const char* what, const fs::path& path, Act act) {
  std::error_code error;
  act(error);
  if (error) {
    throw StoreError(fmt::format("cannot {} {}: {}", what, path.string(), error.message()));
  }
}

/// The files that a run writes itself: NAME-000120.png, or named as RunFolder names them.
bool is_frame(const fs::path& file) {
  const std::string stem = file.stem().string();
  const std::size_t dash = stem.rfind('-');
  return file.extension() == ".png" && dash != std::string::npos && stem.size() - dash > 6 &&
         stem.find_first_not_of("0123456789", dash + 1) == std::string::npos;
}

/// What clca plot leaves.
bool is_figure(const fs::path& file) {
  return file.extension() == ".png";
}

/// What clca export leaves.
bool is_export(const fs::path& file) {
  constexpr std::array<std::string_view, 4> kEndings = {".pvd", ".vtp", ".gsd", ".xyz"};
  return std::find(kEndings.begin(), kEndings.end(), file.extension()) != kEndings.end();
}

/// What a process was writing aside when it was killed.
bool is_leftover(const fs::path& file) {
  const std::string name = file.filename().string();
  const std::size_t part = name.rfind(".part-");
  return part != std::string::npos && part + 6 < name.size() &&
         name.find_first_not_of("0123456789", part + 6) == std::string::npos;
}

/// But run.json and scene.yaml.
bool is_file_of_run(const fs::path& file) {
  constexpr std::array<std::string_view, 10> kWhole = {
      "checkpoint.h5",      "checkpoint-previous.h5",
      "checkpoint-next.h5", "trajectory.h5",
      "report.html",        "series.csv",
      "cycles.csv",         "fields.csv",
      "closure.csv",        "log.txt"};
  constexpr std::array<std::string_view, 8> kOfStages = {"profile-",   "convection-", "contacts-",
                                                         "forces-",    "loads-",      "walls-",
                                                         "histogram-", "fluctuation-"};
  const std::string name = file.filename().string();
  return std::find(kWhole.begin(), kWhole.end(), name) != kWhole.end() ||
         (file.extension() == ".csv" &&
          std::any_of(kOfStages.begin(), kOfStages.end(),
                      [&](std::string_view start) { return name.starts_with(start); }));
}

/// The step in the name of a frame.
std::uint64_t step_of(const fs::path& frame) {
  const std::string stem = frame.stem().string();
  const char* digits = stem.data() + stem.rfind('-') + 1;
  std::uint64_t step = 0;
  std::from_chars(digits, stem.data() + stem.size(), step);
  return step;
}

/// Nothing where there is no such folder.
template <class Matches>
void remove_matching(const fs::path& folder, Matches matches) {
  std::error_code unknown;
  if (!fs::exists(folder, unknown)) {
    return;
  }
  std::vector<fs::path> found;
  checked("read the folder", folder, [&](std::error_code& error) {
    for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
      if (matches(it->path())) {
        found.push_back(it->path());
      }
    }
  });
  for (const fs::path& file : found) {
    checked("remove", file, [&](std::error_code& error) { fs::remove(file, error); });
  }
}

/// The folder, which is there now.
fs::path made(fs::path path) {
  make_folder(path);
  return path;
}

}  // namespace

RunFolder::RunFolder(fs::path path) : path_(made(std::move(path))), lock_(path_) {
  for (const fs::path& folder : {path_, frames(), path_ / "plots", path_ / "trajectory"}) {
    remove_matching(folder, is_leftover);
  }
}

RunFolder RunFolder::for_new_run(fs::path path) {
  RunFolder folder(std::move(path));
  if (fs::exists(folder.summary())) {
    folder.clear_results();
    // Last, so that a process that is killed on the way has not forgotten that there is something.
    for (const fs::path& file : {folder.scene(), folder.summary()}) {
      checked("remove", file, [&](std::error_code& error) { fs::remove(file, error); });
    }
  }
  return folder;
}

RunFolder RunFolder::for_resumed_run(fs::path path) {
  return RunFolder(std::move(path));
}

void RunFolder::clear_results() const {
  remove_matching(frames(), is_frame);
  remove_matching(redrawn_folder(path_), is_frame);
  remove_matching(path_ / "plots", is_figure);
  remove_matching(path_ / "export", is_export);
  remove_matching(path_, is_file_of_run);
  remove_parts(path_, 0);
}

void RunFolder::remove_frames_after(std::optional<std::uint64_t> last_step) const {
  remove_matching(frames(), [&](const fs::path& file) {
    return is_frame(file) && (!last_step || step_of(file) > *last_step);
  });
}

void RunFolder::make_frames() const {
  make_folder(frames());
}

fs::path redrawn_folder(const fs::path& run) {
  return run / "render";
}

std::string frame_name(const std::string& scene, std::uint64_t step) {
  return fmt::format("{}-{:06}.png", scene, step);
}

fs::path frame_path(const fs::path& run, const std::string& scene, std::uint64_t step) {
  return run / "frames" / frame_name(scene, step);
}

}  // namespace clca::store
