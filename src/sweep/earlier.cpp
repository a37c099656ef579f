#include "sweep/earlier.hpp"

#include <algorithm>
#include <string_view>
#include <system_error>

#include "clca/scene/resolve.hpp"
#include "clca/store/checkpoint.hpp"
#include "clca/store/file.hpp"
#include "clca/store/run_folder.hpp"

namespace clca::sweep {

namespace {

namespace fs = std::filesystem;

bool has_text(const fs::path& file, std::string_view text) {
  const auto bytes = store::read_whole(file, scene::kMaxSceneBytes);
  return std::equal(
      bytes.begin(), bytes.end(), text.begin(), text.end(),
      [](std::uint8_t byte, char letter) { return static_cast<char>(byte) == letter; });
}

bool has_pictures(const fs::path& folder, const scene::Scene& scene, std::uint64_t last_step,
                  run::WantedPictures wanted) {
  const auto has = [&](std::uint64_t step) {
    return fs::exists(store::frame_path(folder, scene.name, step, scene::step_digits(scene)));
  };
  // Step 0 is drawn whenever the course of a run is.
  return !scene.output.frames || wanted == run::WantedPictures::none ||
         (has(last_step) && (wanted == run::WantedPictures::last || has(0)));
}

/// Reads the summary of the run in a folder; none if it is not there, cut off or not to be read.
std::optional<store::RunSummary> summary_in(const fs::path& folder) {
  store::look_anew(folder);
  std::error_code unknown;
  if (!fs::exists(folder / store::kSummaryFile, unknown)) {
    return std::nullopt;
  }
  try {
    return store::read_summary(folder / store::kSummaryFile);
  } catch (const store::StoreError&) {
    return std::nullopt;
  }
}

/// Whether a run is of this scene and program version.
bool is_same(const fs::path& folder, const store::RunSummary& summary, const scene::Scene& scene) {
  try {
    return summary.version == run::version() &&
           has_text(folder / store::kSceneFile, scene::to_yaml(scene));
  } catch (const store::StoreError&) {
    return false;
  }
}

}  // namespace

std::optional<EarlierRun> earlier_run(const fs::path& folder, const scene::Scene& scene,
                                      run::WantedPictures pictures) {
  std::optional<store::RunSummary> summary = summary_in(folder);
  if (!summary || summary->status != "done") {
    return std::nullopt;
  }
  EarlierRun earlier = {*std::move(summary)};
  try {
    earlier.is_whole = is_same(folder, earlier.summary, scene) &&
                       has_pictures(folder, scene, earlier.summary.steps, pictures);
  } catch (const fs::filesystem_error&) {  // not to be read: the run is done anew
  }
  return earlier;
}

bool can_go_on(const fs::path& folder, const scene::Scene& scene) {
  const std::optional<store::RunSummary> summary = summary_in(folder);
  std::error_code unknown;
  // A run fails on a full disk, too.
  return summary && summary->status != "done" &&
         fs::exists(folder / store::kCheckpointFile, unknown) && is_same(folder, *summary, scene);
}

}  // namespace clca::sweep
