#pragma once
// One step of the void model, as docs/voids.md has it.

#include <cstdint>
#include <vector>

#include "grains/internal/mechanics.hpp"
#include "voids/rule.hpp"

namespace clca::voids {

struct GrainMove {
  std::uint32_t id = 0;
  grains::Move move = grains::kRest;
};

/// All of a step but the choice of the moves.
class Steps : public grains::Mechanics {
 public:
  Steps(grains::State initial, const Rules& rules);

  grains::Box& box() final { return box_; }
  lattice::Direction down() const final { return lattice::Direction::down; }
  void added(std::size_t first) override { static_cast<void>(first); }
  bool advance(grains::StepReport& report) final;
  std::vector<std::uint32_t> moved() const final { return moved_; }
  /// It has come into a site that was free, so grains above it are awake.
  void removing(std::uint32_t id) final { static_cast<void>(id); }
  void reloaded() override {}

 protected:
  /// The moves of all grains that voids have claimed, from the state as it is.
  virtual std::vector<GrainMove> granted_moves() = 0;
  /// A grain has left this site.
  virtual void vacated(lattice::Site site) { static_cast<void>(site); }

  const grains::State& state() const { return state_; }
  const grains::Box& box() const { return box_; }
  const Rule& rule() const { return rule_; }

 private:
  grains::State state_;
  grains::Box box_;
  Rule rule_;
  std::vector<std::uint32_t> moved_;  // in the last step
};

/// The model as it is defined. Engine does the same faster.
class Reference final : public Steps {
 public:
  using Steps::Steps;

 private:
  std::vector<GrainMove> granted_moves() override;
};

}  // namespace clca::voids
