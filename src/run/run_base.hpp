#pragma once
// What runs of grains and of gases share: summary and log, clock, the way a run begins and ends.

#include <chrono>
#include <cstddef>
#include <exception>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "clca/run/run.hpp"
#include "clca/scene/output.hpp"
#include "clca/store/checkpoint.hpp"
#include "clca/store/output_folder.hpp"
#include "clca/store/run_folder.hpp"
#include "clca/store/summary.hpp"
#include "clca/tasks/background.hpp"
#include "record/internal/meter.hpp"
#include "record/internal/table.hpp"

namespace clca::run {

/// The options with as many threads as could be started: the result does not depend on them. Warns
/// if fewer than requested.
RunOptions with_threads(RunOptions options, int startable, const RunEvents& events);

class RunBase {
 public:
  virtual ~RunBase() = default;
  RunBase(const RunBase&) = delete;
  RunBase& operator=(const RunBase&) = delete;

  store::RunSummary execute();  ///< carries out the run, or the rest of it, and writes its summary

 protected:
  /// The constant part of all summaries of the run.
  struct Identity {
    std::string kind;  ///< as run.json calls it
    std::string scene;
    std::string title;
    std::uint64_t seed = 0;
    std::string scene_text;  ///< resolved
    std::optional<scene::CheckpointIntervals> checkpoint_intervals;
  };

  RunBase(Identity identity, RunOptions options, const RunEvents& events)
      : identity_(std::move(identity)),
        options_(std::move(options)),
        events_(events),
        progress_timer_(events.progress_interval) {
    if (identity_.checkpoint_intervals && identity_.checkpoint_intervals->every_seconds) {
      checkpoint_timer_.emplace(std::chrono::duration_cast<std::chrono::milliseconds>(
          std::chrono::duration<double>(*identity_.checkpoint_intervals->every_seconds)));
    }
  }

  /// Opens the files that grow. Throws store::StoreError for those of a resumed run that its
  /// checkpoint does not fit, before it changes one.
  virtual void open_files() {}
  virtual void carry_out() = 0;
  virtual void complete_summary(store::RunSummary& summary) const = 0;

  /// `folder`: one that has been prepared; none: that of the options, from which the files of an
  /// earlier run are removed. Throws UnfinishedRunError and store::StoreError before it changes
  /// anything.
  void begin(std::optional<store::RunFolder> folder, const store::Checkpoint& start);
  /// Resumes. Keeps the first `log_bytes` of the log. `seconds_before`: wall time until the run
  /// was saved.
  void go_on(store::RunFolder folder, std::uint64_t log_bytes, double seconds_before);
  const RunOptions& options() const { return options_; }
  const RunEvents& events() const { return events_; }
  const store::RunFolder& folder() const { return *folder_; }
  // Write to log.txt and call the callbacks. Failure to write (full disk) does not stop the run.
  void info(const std::string& line) { note("info", line, events_.message); }
  void warning(const std::string& line) { note("warning", line, events_.warning); }
  std::uint64_t log_bytes() const { return log_->size_in_bytes(); }
  /// Calls RunEvents::detail; the log does not have it.
  void tell(const std::string& detail) const {
    if (events_.detail) {
      events_.detail(detail);
    }
  }

  bool stop_is_requested() const {
    return (options_.stop_signal != nullptr && options_.stop_signal->load() != 0) ||
           (options_.wall_seconds_limit && wall_clock_.seconds() >= *options_.wall_seconds_limit);
  }
  double wall_seconds() const { return seconds_before_ + wall_clock_.seconds(); }
  bool progress_due() { return progress_timer_.is_due(); }
  void mark_interrupted() { is_complete_ = false; }
  bool is_complete() const { return is_complete_; }
  std::vector<store::StageSummary>& stage_summaries() { return stages_; }
  bool checkpoint_due(std::uint64_t step);  ///< whether a checkpoint is due after `step` steps
  bool checkpoint_due_by_clock() { return checkpoint_timer_ && checkpoint_timer_->is_due(); }
  /// Writes it in the background. Waits for the previous one and rethrows its error.
  void save(store::Checkpoint checkpoint);
  /// The part of a checkpoint that all runs share; it has no fields.
  store::Checkpoint checkpoint_without_fields() const;

 private:
  store::RunSummary summary(const std::string& status) const;
  void write(const store::RunSummary& summary) const;
  /// Writes summary and scene, and opens the other files; where those of a resumed run do not fit,
  /// summary and scene stay as they were.
  void begin_files();
  void note_failure(const std::exception& failure);
  void note(const char* level, const std::string& line,
            const std::function<void(const std::string&)>& event);

  Identity identity_;
  RunOptions options_;
  const RunEvents& events_;
  record::WallClock wall_clock_;  // since this run began or went on
  double seconds_before_ = 0;
  std::optional<store::RunFolder> folder_;
  std::optional<store::GrowingFile> log_;
  record::IntervalTimer progress_timer_;
  std::optional<record::IntervalTimer> checkpoint_timer_;
  bool is_complete_ = true;
  std::vector<store::StageSummary> stages_;
  /// Memory held back, so that a run that runs out of memory can still write its summary.
  std::optional<std::vector<std::byte>> reserve_ = std::vector<std::byte>(std::size_t{1} << 20U);
  tasks::BackgroundCall writing_;  // last: at the end it waits for its thread
};

}  // namespace clca::run
