#include "run/run_base.hpp"

#include <utility>

#include "clca/store/file.hpp"

namespace clca::run {

store::RunSummary RunBase::execute() {
  // Before scene.yaml: the old summary must not be combined with the new scene.
  write_summary("running");
  folder_->files().write(store::kSceneFile, identity_.scene_text);
  try {
    carry_out();
  } catch (const std::exception& error) {
    note_failure(error);
    throw;
  }
  const std::string status = is_complete() ? "done" : "interrupted";
  write_summary(status);
  if (is_complete() && !identity_.keeps_checkpoint) {
    store::remove_checkpoints(folder_->files());
  }
  return summary(status);
}

void RunBase::write_to(store::RunFolder folder, std::uint64_t log_bytes, double seconds_before) {
  folder_.emplace(std::move(folder));
  log_.emplace(*folder_, log_bytes, events_);
  seconds_before_ = seconds_before;
}

store::Checkpoint RunBase::checkpoint() const {
  return {.kind = identity_.kind,
          .scene_name = identity_.scene,
          .scene = identity_.scene_text,
          .summary = store::to_json(summary("running")),
          .fields = {}};
}

store::RunSummary RunBase::summary(const std::string& status) const {
  store::RunSummary summary = provenance();
  summary.kind = identity_.kind;
  summary.scene = identity_.scene;
  summary.title = identity_.title;
  summary.seed = identity_.seed;
  summary.threads = options_.threads;
  summary.status = status;
  summary.wall_seconds = wall_seconds();
  complete_summary(summary);
  return summary;
}

/// On the disk after all else that the run has written: who reads that it is done finds the rest
/// whole.
void RunBase::write_summary(const std::string& status) const {
  const store::OutputFolder& files = folder_->files();
  store::AtomicFile file = files.create(store::kSummaryFile);
  file.write(store::to_json(summary(status)));
  if (status != "running") {
    files.flush();
    file.flush();
  }
  file.finish();
}

/// If writing the summary fails too (full disk, no memory), the first error is reported.
void RunBase::note_failure(const std::exception& failure) {
  reserve_.reset();
  try {
    log_->error(failure.what());
    write_summary("failed");
  } catch (const std::exception& error) {
    log_->error(error.what());
  }
}

}  // namespace clca::run
