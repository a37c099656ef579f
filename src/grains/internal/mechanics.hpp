#pragma once
// The part of a model that moves grains and walls.

#include <cstdint>
#include <vector>

#include "clca/grains/model.hpp"
#include "grains/internal/box.hpp"

namespace clca::grains {

/// Moves the particles in each step by the rule of a model. A model has one, or two: its
/// definition, for checks, and one that is fast and gives the same bits. No function is called for
/// each particle, except on_removing() for those that leave.
class Mechanics {
 public:
  Mechanics() = default;
  virtual ~Mechanics() = default;
  Mechanics(const Mechanics&) = delete;
  Mechanics& operator=(const Mechanics&) = delete;

  virtual Box& box() = 0;
  virtual lattice::Direction down() const = 0;
  /// Whether particles can be deposited.
  virtual bool can_deposit() const { return true; }

  // Called in this order in each step, see step().
  virtual void before_sources() {}
  /// Particles from id `first` on are new: sources have emitted them.
  virtual void on_added(std::size_t /*first*/) {}
  /// Moves grains and walls, and counts the step. Sets `moved_count` of the report, which already
  /// has `emitted_count`. Returns whether the state is settled if no source will emit.
  virtual bool advance(StepReport& report) = 0;
  /// The particles that have moved in this step; may have duplicates.
  virtual std::vector<std::uint32_t> moved_ids() const = 0;
  /// A particle is about to be removed.
  virtual void on_removing(std::uint32_t /*id*/) {}

  /// Particles were added or walls changed in between steps.
  virtual void on_reloaded() {}
  /// A wall was set in motion or stopped.
  virtual void on_motion_set() {}
};

/// One step of any model.
StepReport step(Mechanics& mechanics);

}  // namespace clca::grains
