#include "run/begin.hpp"

#include <fmt/format.h>

namespace clca::run {

namespace {

/// "wall-removal, seed 2001, done 2026-11-22 14:05"
std::string description(const store::EarlierRun& earlier) {
  const store::RunSummary& run = earlier.summary;
  return fmt::format("{}, seed {}, {}{}{}", run.scene, run.seed,
                     run.status == "running" ? "not done" : run.status,
                     earlier.when.empty() ? "" : " ", earlier.when);
}

}  // namespace

store::RunFolder begin_run(const RunOptions& options, const RunEvents& events,
                           const store::Checkpoint& start, const std::vector<std::string>& files) {
  store::RunFolder folder = store::RunFolder::for_new_run(options.folder);
  for (const std::string& name : files) {
    folder.files().require_free(name);
  }
  if (const auto earlier = folder.earlier_run()) {
    const std::string run = description(*earlier);
    if (earlier->unfinished && !options.overwrite) {
      throw UnfinishedRunError(
          fmt::format("{}: there is a run that can go on ({}): clca resume goes on with it, "
                      "--overwrite begins anew, --keep runs in another folder",
                      options.folder.string(), run));
    }
    if (events.message) {
      events.message(fmt::format("replacing the run in {}: {}", options.folder.string(), run));
    }
  }
  folder.start_over(start);
  return folder;
}

}  // namespace clca::run
