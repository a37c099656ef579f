#pragma once
// What runs of grains and of gases share: summary and log, clock, the way a run begins and ends.

#include <exception>
#include <optional>
#include <string>

#include "clca/run/run.hpp"
#include "clca/store/checkpoint.hpp"
#include "clca/store/run_folder.hpp"
#include "clca/store/summary.hpp"
#include "run/log.hpp"
#include "run/memory_reserve.hpp"
#include "run/meter.hpp"

namespace clca::run {

class RunBase {
 public:
  virtual ~RunBase() = default;
  RunBase(const RunBase&) = delete;
  RunBase& operator=(const RunBase&) = delete;

  /// Carries the run out, or on, and leaves its summary.
  store::RunSummary execute();

 protected:
  /// What all summaries of the run say.
  struct Identity {
    std::string kind;  ///< as run.json calls it
    std::string scene;
    std::string title;
    std::uint64_t seed = 0;
    std::string scene_text;  ///< resolved
    bool keeps_checkpoint = false;
  };

  RunBase(Identity identity, RunOptions options, const RunEvents& events)
      : identity_(std::move(identity)), options_(std::move(options)), events_(events) {}

  virtual void carry_out() = 0;
  virtual bool is_complete() const = 0;
  virtual void complete_summary(store::RunSummary& summary) const = 0;

  /// Keeps the first `log_bytes` of the log. `seconds_before`: by the clock, until the run was
  /// saved.
  void write_to(store::RunFolder folder, std::uint64_t log_bytes, double seconds_before);
  const RunOptions& options() const { return options_; }
  const RunEvents& events() const { return events_; }
  const store::RunFolder& folder() const { return *folder_; }
  Log& log() { return *log_; }
  void tell(const std::string& detail) const {
    if (events_.detail) {
      events_.detail(detail);
    }
  }

  bool stop_asked() const {
    return (options_.stop != nullptr && options_.stop->load() != 0) ||
           (options_.time_limit && wall_clock_.seconds() >= *options_.time_limit);
  }
  double wall_seconds() const { return seconds_before_ + wall_clock_.seconds(); }
  /// Without fields.
  store::Checkpoint checkpoint() const;

 private:
  store::RunSummary summary(const std::string& status) const;
  void write_summary(const std::string& status) const;
  void note_failure(const std::exception& failure);

  Identity identity_;
  RunOptions options_;
  const RunEvents& events_;
  WallClock wall_clock_;  // since this run began or went on
  double seconds_before_ = 0;
  std::optional<store::RunFolder> folder_;
  std::optional<Log> log_;
  MemoryReserve reserve_;
};

}  // namespace clca::run
