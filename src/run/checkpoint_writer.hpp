#pragma once
// Decides when to save a checkpoint and writes it in the background.

#include <future>
#include <optional>

#include "clca/scene/output.hpp"
#include "clca/store/checkpoint.hpp"
#include "run/meter.hpp"

namespace clca::run {

class CheckpointWriter {
 public:
  explicit CheckpointWriter(const std::optional<scene::Checkpoints>& when);

  /// Whether a checkpoint is due after `step` steps.
  bool due(std::uint64_t step);
  bool due_by_clock() { return timer_ && timer_->due(); }
  /// Writes the checkpoint on a thread of its own if possible. Waits for the previous one and
  /// rethrows its error.
  void save(const store::OutputFolder& run_folder, store::Checkpoint checkpoint);
  /// Waits until everything is written. Rethrows its error.
  void finish();

 private:
  std::optional<scene::Checkpoints> when_;
  std::optional<IntervalTimer> timer_;
  std::future<void> writing_;
};

}  // namespace clca::run
