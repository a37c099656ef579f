#include "clca/store/run_folder.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <chrono>
#include <system_error>

#include "clca/store/file.hpp"
#include "clca/text/read.hpp"

namespace clca::store {

namespace {

namespace fs = std::filesystem;

constexpr double kMaxCheckpointBytes = 1 << 30;  // to see which run it is of

/// The step in the name of a frame; none for other names.
std::optional<std::uint64_t> step_of(const std::string& name) {
  const std::size_t dash = name.rfind('-');
  if (!name.starts_with(std::string(kFramesFolder) + "/") || !name.ends_with(".png") ||
      dash == std::string::npos) {
    return std::nullopt;
  }
  const std::size_t end = name.size() - std::string_view(".png").size();
  return text::number<std::uint64_t>(name.substr(dash + 1, end - dash - 1));
}

/// "2026-11-22 14:05", local time; empty if unknown.
std::string time_of(const fs::path& file) {
  std::error_code error;
  const fs::file_time_type written = fs::last_write_time(file, error);
  if (error) {
    return "";
  }
  const auto seconds =
      std::chrono::floor<std::chrono::seconds>(std::chrono::file_clock::to_sys(written));
  return fmt::format("{:%Y-%m-%d %H:%M}",
                     fmt::localtime(std::chrono::system_clock::to_time_t(seconds)));
}

bool is_of_run(const OutputFolder& files) {
  return files.owns(kSummaryFile) || files.owns(kCheckpointFile) ||
         files.owns(kPreviousCheckpointFile);
}

}  // namespace

std::optional<RunSummary> finished_summary(const fs::path& run_folder) {
  try {
    RunSummary summary = read_summary(run_folder / kSummaryFile);
    return summary.status == "done" ? std::optional(std::move(summary)) : std::nullopt;
  } catch (const StoreError&) {
    return std::nullopt;
  }
}

RunFolder::RunFolder(const fs::path& path, FolderLock lock)
    : lock_(std::move(lock)), folder_(path) {
  remove_abandoned_files(path);  // a run that is done writes nothing, which would remove them
  folder_.delay_flushing();
}

RunFolder RunFolder::for_new_run(const fs::path& path) {
  {
    const OutputFolder files(path);
    files.require_clca_folder();
    const std::vector<std::string> there = files.listed_files();
    if (!there.empty() && !is_of_run(files)) {
      throw StoreError(fmt::format(
          "cannot run in {}: clca has written something else than a run there ({}); run elsewhere",
          path.string(), there.front()));
    }
  }
  make_folder(path);
  return {path, FolderLock(path)};
}

RunFolder RunFolder::for_resumed_run(const fs::path& path) {
  std::error_code unknown;
  if (!fs::is_directory(path, unknown)) {
    throw StoreError(
        fmt::format("cannot resume the run in {}: there is no such folder", path.string()));
  }
  if (!is_of_run(OutputFolder(path))) {
    const char* reason = fs::exists(path / "checkpoint.h5", unknown)
                             ? "an older version of clca has written it"
                         : fs::exists(path / kSummaryFile, unknown)
                             ? "no run has begun there, or it has lost its .clca.manifest"
                             : "no run has begun there";
    throw StoreError(fmt::format("cannot resume the run in {}: {}", path.string(), reason));
  }
  return {path, FolderLock(path)};
}

std::optional<EarlierRun> RunFolder::earlier_run() const {
  if (folder_.listed_files().empty()) {
    return std::nullopt;
  }
  const fs::path summary = path() / kSummaryFile;
  std::error_code unknown;
  bool has_summary = fs::exists(summary, unknown);
  std::string problem;
  EarlierRun earlier;
  try {
    if (has_summary) {
      earlier.summary = read_summary(summary);
      earlier.written_at = time_of(summary);
    }
  } catch (const StoreError& error) {
    has_summary = false;
    problem = error.what();
  }
  if (has_summary && earlier.summary.status == "done") {
    return earlier;
  }
  earlier.is_resumable = true;
  try {
    const auto found = read_checkpoint(path(), kMaxCheckpointBytes);
    earlier.is_resumable = found && !found->checkpoint.is_before_first_step();
    if (!found && !has_summary) {
      throw StoreError(problem.empty() ? "it has neither run.json nor a checkpoint" : problem);
    }
    if (!has_summary) {
      earlier.summary = parse_summary(found->checkpoint.summary_json, "its checkpoint");
    }
  } catch (const StoreError& error) {  // without run.json nobody can say whose files they are
    if (!has_summary) {
      throw StoreError(
          fmt::format("cannot run in {}: clca has written files there, but of which "
                      "run cannot be told: {}",
                      path().string(), error.what()));
    }
  }
  return earlier;
}

// run.json first, so that the rest is not mistaken for a complete run.
void RunFolder::start_over(const Checkpoint& start) const {
  write_checkpoint(folder_, start, PreviousCheckpoint::replaced);
  folder_.clear(kSummaryFile, kCheckpointFile);
}

void RunFolder::remove_frames_after(std::optional<std::uint64_t> last_step) const {
  for (const std::string& name : folder_.listed_files()) {
    if (const auto step = step_of(name); step && (!last_step || *step > *last_step)) {
      folder_.remove(name);
    }
  }
}

std::string table_name(std::string_view kind, const std::string& stage) {
  return fmt::format("{}{}{}.csv", kind, stage.empty() ? "" : "-", stage);
}

std::string frame_name(const std::string& scene, std::uint64_t step, int digits,
                       std::string_view ending) {
  return fmt::format("{}-{:0{}}{}", scene, step, digits, ending);
}

fs::path frame_path(const fs::path& run, const std::string& scene, std::uint64_t step, int digits) {
  return run / kFramesFolder / frame_name(scene, step, digits);
}

}  // namespace clca::store
