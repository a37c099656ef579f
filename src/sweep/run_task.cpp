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

/// Goes on with a run that was stopped or killed. None if there is no such run, or if it fails:
/// then it is run from the start, so that a message names the scene as it does always.
std::optional<store::RunSummary> continued(const scene::Scene& scene,
                                           const std::filesystem::path& folder,
                                           const Options& options, const run::RunOptions& run,
                                           const run::RunEvents& events) {
  if (!can_go_on(folder, scene)) {
    return std::nullopt;
  }
  try {
    store::RunSummary summary = run::resume(run::load_run(folder, options.max_bytes), run, events);
    const auto now = earlier_run(folder, scene, run.pictures);
    // It draws the pictures that were wanted when it began.
    return summary.status != "done" || (now && now->is_whole) ? std::optional(std::move(summary))
                                                              : std::nullopt;
  } catch (const store::FolderInUseError&) {
    throw;
  } catch (const std::exception&) {
    return std::nullopt;
  }
}

/// What of a finished run goes from one process to another, beside its summary.
struct SentRun {
  Status status = Status::waiting;
  std::string error;
  std::vector<std::string> warnings;
  std::string store_error;
  bool is_elsewhere = false;

  static constexpr auto fields() {
    using reflection::field;
    return std::make_tuple(field("status", &SentRun::status), field("error", &SentRun::error),
                           field("warnings", &SentRun::warnings),
                           field("store_error", &SentRun::store_error),
                           field("is_elsewhere", &SentRun::is_elsewhere));
  }
};

}  // namespace

FinishedRun execute_run(const scene::Scene& scene, const std::filesystem::path& folder,
                        const Options& options, run::WantedPictures pictures,
                        const std::atomic<int>* stop) {
  FinishedRun one;
  one.result.status = Status::failed;
  try {
    std::error_code unknown;
    if (std::filesystem::is_symlink(folder, unknown)) {
      throw store::StoreError(
          fmt::format("cannot run in {}: it is a symbolic link", folder.string()));
    }
    run::RunEvents events;
    events.warning = [&one](const std::string& text) { one.warnings.push_back(text); };
    const run::RunOptions run = {
        .folder = folder, .threads = 1, .stop = stop, .pictures = pictures, .overwrite = true};
    auto summary = continued(scene, folder, options, run, events);
    one.result.summary = summary ? *std::move(summary) : run::run(scene, run, events);
    one.result.status = one.result.summary.status == "done" ? Status::done : Status::interrupted;
  } catch (const store::FolderInUseError&) {
    one.result.status = Status::waiting;
    one.is_elsewhere = true;
  } catch (const store::StoreError& error) {
    one.result.error = error.what();
    one.store_error = error.what();
  } catch (const std::bad_alloc&) {
    one.result.error = "out of memory";
  } catch (const std::exception& error) {
    one.result.error = error.what();
  }
  return one;
}

tasks::Bytes to_bytes(const FinishedRun& run) {
  const SentRun sent = {.status = run.result.status,
                        .error = run.result.error,
                        .warnings = run.warnings,
                        .store_error = run.store_error,
                        .is_elsewhere = run.is_elsewhere};
  return store::checkpoint_bytes({.kind = "finished run",
                                  .scene_name = "",
                                  .scene = "",
                                  .summary = store::to_json(run.result.summary),
                                  .fields = reflection::encode(sent)});
}

FinishedRun finished_run(const tasks::Bytes& bytes) {
  constexpr double kAnySize = std::numeric_limits<double>::infinity();
  const store::Checkpoint content = store::parse_checkpoint(bytes, kAnySize);
  SentRun sent;
  reflection::decode(content.fields, kAnySize, sent);
  FinishedRun run = {.result = {.status = sent.status, .summary = {}, .error = sent.error},
                     .warnings = sent.warnings,
                     .store_error = sent.store_error,
                     .is_elsewhere = sent.is_elsewhere};
  if (sent.status == Status::done) {
    run.result.summary = store::parse_summary(content.summary, "a run of another rank");
  }
  return run;
}

}  // namespace clca::sweep
