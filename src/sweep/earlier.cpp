#include "sweep/earlier.hpp"

#include <algorithm>
#include <string_view>

#include "clca/run/run.hpp"
#include "clca/scene/resolve.hpp"
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
                  bool all) {
  const auto has = [&](std::uint64_t step) {
    return fs::exists(store::frame_path(folder, scene.name, step));
  };
  // Step 0 is drawn whenever the course of a run is.
  return !scene.output.frames || (has(last_step) && (!all || has(0)));
}

}  // namespace

std::optional<store::RunSummary> earlier_run(const fs::path& folder, const scene::Scene& scene,
                                             bool all_pictures) {
  try {
    if (!fs::exists(folder / "run.json") ||
        !has_text(folder / "scene.yaml", scene::to_yaml(scene))) {
      return std::nullopt;
    }
    store::RunSummary summary = store::read_summary(folder / "run.json");
    const bool whole = summary.status == "done" && summary.version == run::version() &&
                       has_pictures(folder, scene, summary.steps, all_pictures);
    return whole ? std::optional(std::move(summary)) : std::nullopt;
  } catch (const store::StoreError&) {
    return std::nullopt;  // cut off, or not to be read: the run is done anew
  } catch (const fs::filesystem_error&) {
    return std::nullopt;
  }
}

}  // namespace clca::sweep
