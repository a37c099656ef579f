// One run of a sweep, new or of an earlier sweep.

#include <fmt/format.h>

#include <limits>
#include <new>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "clca/store/checkpoint.hpp"
#include "clca/store/file.hpp"
#include "clca/store/output_folder.hpp"
#include "clca/store/run_folder.hpp"
#include "sweep/results.hpp"

namespace clca::sweep {

namespace {

namespace fs = std::filesystem;

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
  store::refresh_folder(folder);
  try {
    return store::read_summary(folder / store::kSummaryFile);
  } catch (const store::StoreError&) {
    return std::nullopt;
  }
}

/// Whether a run is of this scene and program version.
bool is_same(const fs::path& folder, const store::RunSummary& summary, const scene::Scene& scene) {
  try {
    const auto text = store::read_whole_file(folder / store::kSceneFile, document::kMaxBytes);
    return summary.version == store::version() &&
           std::string(text.begin(), text.end()) == scene::to_yaml(scene);
  } catch (const store::StoreError&) {
    return false;
  }
}

/// The run of exactly this scene and program version in a folder, where it was stopped or killed or
/// has failed. None if there is no such run, if its checkpoint cannot be used, or if it has not
/// drawn what is wanted now.
std::optional<run::SavedRun> saved_run(const scene::Scene& scene, const fs::path& folder,
                                       double max_bytes, run::WantedPictures wanted,
                                       const run::RunEvents& events) {
  const std::optional<store::RunSummary> summary = summary_in(folder);
  std::error_code unknown;
  // A run fails on a full disk, too.
  if (!summary || summary->status == "done" ||
      !fs::exists(folder / store::kCheckpointFile, unknown) || !is_same(folder, *summary, scene)) {
    return std::nullopt;
  }
  try {
    run::SavedRun saved = run::load_run(folder, max_bytes);
    return run::wanted_pictures_of(saved) <= wanted ? std::optional(std::move(saved))
                                                    : std::nullopt;
  } catch (const store::FolderInUseError&) {
    throw;
  } catch (const std::runtime_error& error) {
    events.warning(fmt::format("{}: begins anew", error.what()));
    return std::nullopt;
  }
}

store::RunSummary executed(const scene::Scene& scene, const fs::path& folder, double max_bytes,
                           const run::RunOptions& run, const run::RunEvents& events) {
  if (auto saved = saved_run(scene, folder, max_bytes, run.pictures, events)) {
    try {
      return run::resume(*std::move(saved), run, events);
    } catch (const store::UnusableCheckpointError& error) {
      events.warning(fmt::format("{}: begins anew", error.what()));
    } catch (const scene::SceneError&) {
      // Told from the start, with the location in the user's scene.
    }
  }
  return run::run(scene, run, events);
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
    earlier.is_reusable = is_same(folder, earlier.summary, scene) &&
                          has_pictures(folder, scene, earlier.summary.steps, pictures);
  } catch (const fs::filesystem_error&) {  // not to be read: the run is done anew
  }
  return earlier;
}

RunOutcome execute_run(const scene::Scene& scene, const std::filesystem::path& folder,
                       const Options& options, run::WantedPictures pictures,
                       const std::atomic<int>* stop,
                       std::function<void(const run::Progress&)> progress) {
  RunOutcome finished;
  finished.result.status = Status::failed;
  try {
    std::error_code unknown;
    if (std::filesystem::is_symlink(folder, unknown)) {
      throw store::StoreError(
          fmt::format("cannot run in {}: it is a symbolic link", folder.string()));
    }
    run::RunEvents events;
    events.progress = std::move(progress);
    events.warning = [&finished](const std::string& text) { finished.warnings.push_back(text); };
    const run::RunOptions run = {.folder = folder,
                                 .threads = 1,
                                 .stop_signal = stop,
                                 .pictures = pictures,
                                 .replace_interrupted = true};
    finished.result.summary = executed(scene, folder, options.max_bytes, run, events);
    finished.result.status =
        finished.result.summary.status == "done" ? Status::done : Status::interrupted;
  } catch (const store::FolderInUseError&) {
    finished.result.status = Status::waiting;
    finished.is_in_use = true;
  } catch (const store::StoreError& error) {
    finished.result.error = error.what();
    finished.store_error = error.what();
  } catch (const std::bad_alloc&) {
    finished.result.error = "out of memory";
  } catch (const std::exception& error) {
    finished.result.error = error.what();
  }
  return finished;
}

tasks::Bytes to_bytes(const RunOutcome& run) {
  return store::checkpoint_bytes({.kind = "finished run",
                                  .scene_name = "",
                                  .scene_text = "",
                                  .summary_json = store::to_json(run.result.summary),
                                  .fields = reflection::encode(run)});
}

RunOutcome run_outcome(const tasks::Bytes& bytes) {
  constexpr double kAnySize = std::numeric_limits<double>::infinity();
  const store::Checkpoint content = store::parse_checkpoint(bytes, kAnySize);
  RunOutcome run;
  reflection::decode(content.fields, kAnySize, run);
  if (run.result.status == Status::done) {
    run.result.summary = store::parse_summary(content.summary_json, "a run of another rank");
  }
  return run;
}

}  // namespace clca::sweep
