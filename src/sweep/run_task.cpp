#include "sweep/run_task.hpp"

#include <fmt/format.h>

#include <limits>
#include <new>
#include <optional>
#include <utility>

#include "clca/run/run.hpp"
#include "clca/store/checkpoint.hpp"
#include "clca/store/folder_lock.hpp"
#include "sweep/earlier.hpp"

namespace clca::sweep {

namespace {

namespace fs = std::filesystem;

/// The run in a folder, where it was stopped or killed. None if there is no such run, if its
/// checkpoint cannot be used, or if it has not drawn what is wanted now.
std::optional<run::SavedRun> saved_run(const scene::Scene& scene, const fs::path& folder,
                                       double max_bytes, run::WantedPictures wanted,
                                       const run::RunEvents& events) {
  if (!can_go_on(folder, scene)) {
    return std::nullopt;
  }
  try {
    run::SavedRun saved = run::load_run(folder, max_bytes);
    return run::saved_pictures(saved) <= wanted ? std::optional(std::move(saved)) : std::nullopt;
  } catch (const store::FolderInUseError&) {
    throw;
  } catch (const store::StoreError& error) {
    events.warning(fmt::format("{}: begins anew", error.what()));
  } catch (const scene::SceneError& error) {
    events.warning(fmt::format("{}: begins anew", error.what()));
  } catch (const reflection::Mismatch& error) {
    events.warning(fmt::format("its checkpoint is not of this run: {}: begins anew", error.what()));
  }
  return std::nullopt;
}

store::RunSummary executed(const scene::Scene& scene, const fs::path& folder, double max_bytes,
                           const run::RunOptions& run, const run::RunEvents& events) {
  if (auto saved = saved_run(scene, folder, max_bytes, run.pictures, events)) {
    try {
      return run::resume(*std::move(saved), run, events);
    } catch (const store::UnusableCheckpointError& error) {
      events.warning(fmt::format("{}: begins anew", error.what()));
    } catch (
        const run::SceneRunError&) {  // told from the start, with the location in the user's scene
    }
  }
  return run::run(scene, run, events);
}

}  // namespace

FinishedRun execute_run(const scene::Scene& scene, const std::filesystem::path& folder,
                        const Options& options, run::WantedPictures pictures,
                        const std::atomic<int>* stop) {
  FinishedRun finished;
  finished.result.status = Status::failed;
  try {
    std::error_code unknown;
    if (std::filesystem::is_symlink(folder, unknown)) {
      throw store::StoreError(
          fmt::format("cannot run in {}: it is a symbolic link", folder.string()));
    }
    run::RunEvents events;
    events.warning = [&finished](const std::string& text) { finished.warnings.push_back(text); };
    const run::RunOptions run = {
        .folder = folder, .threads = 1, .stop = stop, .pictures = pictures, .overwrite = true};
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

tasks::Bytes to_bytes(const FinishedRun& run) {
  return store::checkpoint_bytes({.kind = "finished run",
                                  .scene_name = "",
                                  .scene = "",
                                  .summary = store::to_json(run.result.summary),
                                  .fields = reflection::encode(run)});
}

FinishedRun finished_run(const tasks::Bytes& bytes) {
  constexpr double kAnySize = std::numeric_limits<double>::infinity();
  const store::Checkpoint content = store::parse_checkpoint(bytes, kAnySize);
  FinishedRun run;
  reflection::decode(content.fields, kAnySize, run);
  if (run.result.status == Status::done) {
    run.result.summary = store::parse_summary(content.summary, "a run of another rank");
  }
  return run;
}

}  // namespace clca::sweep
