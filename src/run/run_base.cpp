#include "run/run_base.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/stat.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <set>
#include <utility>

#include "clca/record/quantity.hpp"
#include "clca/store/file.hpp"

namespace clca::run {

namespace {

namespace fs = std::filesystem;

/// "wall-removal, seed 2001, done 2026-11-22 14:05"
std::string description(const store::EarlierRun& earlier) {
  const store::RunSummary& run = earlier.summary;
  return fmt::format("{}, seed {}, {}{}{}", run.scene, run.seed,
                     run.status == "running" ? "not done" : run.status,
                     earlier.written_at.empty() ? "" : " ", earlier.written_at);
}

/// Makes the first of FOLDER, FOLDER-2, ... that does not exist.
fs::path make_unused_folder(const fs::path& folder) {
  const fs::path wanted = folder.has_filename() ? folder : folder.parent_path();
  if (wanted.has_parent_path()) {
    store::make_folder(wanted.parent_path());
  }
  for (int number = 1;; ++number) {
    fs::path path = number == 1 ? wanted : fs::path(fmt::format("{}-{}", wanted.string(), number));
    if (::mkdir(path.c_str(), 0777) == 0) {
      return path;
    }
    if (errno != EEXIST) {
      throw store::StoreError(
          fmt::format("cannot make the folder {}: {}", path.string(), std::strerror(errno)));
    }
  }
}

}  // namespace

RunOptions with_threads(RunOptions options, int startable, const RunEvents& events) {
  const int wanted = std::exchange(options.threads, startable);
  if (options.threads < wanted && events.warning) {
    events.warning(fmt::format("only {} of {} threads can be started", options.threads, wanted));
  }
  return options;
}

void RunBase::begin_files() {
  constexpr double kMostBytes = 16 << 20;
  const store::OutputFolder& files = folder_->output_folder();
  const fs::path file = files.path() / store::kSummaryFile;
  const bool is_resumed = fs::exists(file);
  const auto old =
      is_resumed ? store::read_whole_file(file, kMostBytes) : std::vector<std::uint8_t>();
  // First: no summary says that a run is done whose files are cut or whose scene is another one.
  write(summary("running"));
  try {
    open_files();
  } catch (const std::exception& error) {
    if (is_resumed) {
      files.write(store::kSummaryFile, old);
    } else {
      note_failure(error);
    }
    throw;
  }
  files.write(store::kSceneFile, identity_.scene_text);
}

store::RunSummary RunBase::execute() {
  begin_files();
  try {
    carry_out();
    writing_.finish();
  } catch (const std::exception& error) {
    note_failure(error);
    throw;
  }
  store::RunSummary last = summary(is_complete_ ? "done" : "interrupted");
  write(last);
  if (is_complete_ && !identity_.checkpoint_intervals) {
    store::remove_checkpoints(folder_->output_folder());
  }
  return last;
}

void RunBase::begin(std::optional<store::RunFolder> folder, const store::Checkpoint& start) {
  if (folder) {
    go_on(*std::move(folder), 0, 0);
    return;
  }
  const fs::path path =
      options_.keep_earlier_run ? make_unused_folder(options_.folder) : options_.folder;
  if (events_.folder_known) {
    events_.folder_known(path);
  }
  store::RunFolder made = store::RunFolder::for_new_run(path);
  if (const auto earlier = made.earlier_run()) {
    const std::string run = description(*earlier);
    if (earlier->is_resumable && !options_.replace_interrupted) {
      throw UnfinishedRunError(
          fmt::format("{}: there is an unfinished run ({}): continue it with clca resume, "
                      "replace it with --overwrite, or run in another folder with --keep",
                      path.string(), run));
    }
    if (events_.message) {
      events_.message(fmt::format("replacing the run in {}: {}", path.string(), run));
    }
  }
  made.start_over(start);
  go_on(std::move(made), 0, 0);
}

void RunBase::go_on(store::RunFolder folder, std::uint64_t log_bytes, double seconds_before) {
  folder_.emplace(std::move(folder));
  log_.emplace(folder_->output_folder(), store::kLogFile, log_bytes);
  seconds_before_ = seconds_before;
}

bool RunBase::checkpoint_due(std::uint64_t step) {
  const auto& when = identity_.checkpoint_intervals;
  return (when && when->every_steps && step % *when->every_steps == 0) || checkpoint_due_by_clock();
}

void RunBase::save(store::Checkpoint checkpoint) {
  writing_.start([run_folder = folder_->output_folder(), checkpoint = std::move(checkpoint)] {
    store::write_checkpoint(run_folder, checkpoint);
  });
}

void RunBase::note(const char* level, const std::string& line,
                   const std::function<void(const std::string&)>& event) {
  using std::chrono::system_clock;
  const system_clock::time_point now = system_clock::now();
  const auto milliseconds =
      std::chrono::duration_cast<std::chrono::milliseconds>(now.time_since_epoch()) %
      std::chrono::seconds(1);
  try {
    log_->append(fmt::format("{:%Y-%m-%d %H:%M:%S}.{:03} {}: {}\n",
                             fmt::localtime(system_clock::to_time_t(now)), milliseconds.count(),
                             level, line));
  } catch (const store::StoreError&) {  // the run goes on without it
  }
  if (event) {
    event(line);
  }
}

store::Checkpoint RunBase::checkpoint_without_fields() const {
  store::RunSummary now = summary("running");
  now.measure_descriptions.clear();  // only run.json has to say what its numbers are
  now.table_descriptions.clear();
  return {.kind = identity_.kind,
          .scene_name = identity_.scene,
          .scene_text = identity_.scene_text,
          .summary_json = store::to_json(now),
          .fields = {}};
}

store::RunSummary RunBase::summary(const std::string& status) const {
  store::RunSummary summary = store::summary_with_provenance();
  summary.kind = identity_.kind;
  summary.scene = identity_.scene;
  summary.title = identity_.title;
  summary.seed = identity_.seed;
  summary.threads = options_.threads;
  summary.status = status;
  summary.wall_seconds = wall_seconds();
  summary.stages = stages_;
  complete_summary(summary);
  const record::KnownQuantities known = record::known_quantities(summary);
  std::set<std::string> keys;
  for (const store::StageSummary& stage : summary.stages) {
    for (const auto& [key, value] : stage.measures) {
      if (keys.insert(key).second) {
        summary.measure_descriptions.push_back(
            known.find(key).value_or(store::ColumnSummary{.key = key, .name = key}));
      }
    }
  }
  return summary;
}

/// On the disk after all else that the run has written: who reads that it is done finds the rest
/// whole.
void RunBase::write(const store::RunSummary& summary) const {
  const store::OutputFolder& files = folder_->output_folder();
  store::AtomicFile file = files.create(store::kSummaryFile);
  file.write(store::to_json(summary));
  if (summary.status != "running") {
    files.flush();
    file.flush();
  }
  file.finish();
}

/// If writing the summary fails too (full disk, no memory), the first error is reported.
void RunBase::note_failure(const std::exception& failure) {
  reserve_.reset();
  try {
    note("error", failure.what(), {});
    write(summary("failed"));
  } catch (const std::exception& error) {
    note("error", error.what(), {});
  }
}

}  // namespace clca::run
