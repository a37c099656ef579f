#pragma once
// When a run saves its checkpoint, and how: beside the simulation.

#include <functional>
#include <future>
#include <optional>

#include "clca/scene/output.hpp"
#include "clca/store/checkpoint.hpp"
#include "run/meter.hpp"

namespace clca::run {

class Saver {
 public:
  explicit Saver(const std::optional<scene::Checkpoints>& when);

  /// Whether it is time, after so many steps of the run.
  bool due(std::uint64_t step);
  /// Writes the checkpoint, on a thread of its own where it can be had, `before` it what has to be
  /// on the disk first. Waits for the one before. Rethrows what went wrong with that.
  void save(const store::OutputFolder& run_folder, store::Checkpoint checkpoint,
            std::function<void()> before);
  /// Waits until all is written. Rethrows likewise.
  void finish();

 private:
  std::optional<scene::Checkpoints> when_;
  std::optional<Ticker> ticker_;
  std::future<void> writing_;
};

}  // namespace clca::run
