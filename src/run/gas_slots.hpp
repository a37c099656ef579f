#pragma once
// Collects copies of the gases of an ensemble for a checkpoint.

#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <vector>

#include "model/internal/gas_member.hpp"
#include "run/run_base.hpp"

namespace clca::run {

/// When a checkpoint is due, each running gas stores a copy after its next step, from its own
/// thread; the last one saves.
/// Gases are independent, so the copies may be from different times.
class GasSlots {
 public:
  /// `save` writes all `members`; called by one thread at a time while no member changes.
  GasSlots(std::vector<model::GasMember>& members, CheckpointWriter& checkpoint_writer,
           std::function<void()> save)
      : members_(members), checkpoint_writer_(checkpoint_writer), save_(std::move(save)) {}

  /// Moves a member out, to be advanced.
  model::GasMember begin(std::size_t number);
  void after_step(std::size_t number, const model::GasMember& member);
  /// For rank 0 when no gas is running in this process: saves if that is due by the clock.
  void save_if_time();
  /// Of a member as it was last put here.
  std::uint64_t participations(std::size_t number);
  /// Moves it back, from here or another process.
  void end(std::size_t number, model::GasMember member);

 private:
  void collect();
  void save_when_complete();

  std::vector<model::GasMember>& members_;
  CheckpointWriter& checkpoint_writer_;
  std::function<void()> save_;
  std::mutex mutex_;
  bool collecting_ = false;
  std::map<std::size_t, bool> running_;  // and whether its copy is still to come
};

}  // namespace clca::run
