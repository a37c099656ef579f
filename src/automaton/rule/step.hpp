#pragma once
// One step of the automaton, as docs/model.md has it.

#include <cstdint>
#include <utility>
#include <vector>

#include "automaton/rule/decisions.hpp"
#include "automaton/rule/world.hpp"
#include "clca/grains/model.hpp"
#include "grains/internal/mechanics.hpp"

namespace clca::automaton {

/// "One step" of docs/model.md, but for points 3 and 4: the particles' own moves.
class Steps : public grains::Mechanics {
 public:
  /// Throws std::invalid_argument if the state is not valid (see grains::Occupancy).
  Steps(grains::State initial, const Rules& rules);

  const Rules& rules() const { return world_.rules; }

  grains::Box& box() final { return box_; }
  lattice::Direction down() const final { return world_.rules.gravity; }
  bool deposits() const final { return world_.rules.gravity == lattice::Direction::down; }
  void before_sources() final;
  void added(std::size_t first) final { world_.include_new(first); }
  bool advance(grains::StepReport& report) final;
  std::vector<std::uint32_t> moved() const final;
  void removing(std::uint32_t id) final { world_.let_go(id); }
  void reloaded() final { world_.reload(); }

 protected:
  /// Points 3 and 4. Returns how many particles moved.
  virtual std::size_t move_particles() = 0;
  /// True when no particle that overlaps had moved in the step before the last.
  virtual bool was_quiet() const = 0;
  /// Those that moved by themselves in this step.
  virtual void append_moved(std::vector<std::uint32_t>& ids) const = 0;

  World& world() { return world_; }
  Decisions& decisions() { return decisions_; }

 private:
  grains::State state_;
  grains::Box box_;
  World world_;
  Decisions decisions_;
  bool wall_moved_ = false;
};

/// Points 3 and 4 of a step as the model is defined. Engine does the same faster.
class Reference final : public Steps {
 public:
  Reference(grains::State initial, const Rules& rules)
      : Steps(std::move(initial), rules), world_(world()), decisions_(decisions()) {}

 private:
  struct ProposedMove {
    UpdateKey key;
    lattice::Direction direction = lattice::Direction::down;
  };

  std::size_t move_particles() override;
  bool was_quiet() const override { return quiet_; }
  void append_moved(std::vector<std::uint32_t>& ids) const override {
    ids.insert(ids.end(), moved_.begin(), moved_.end());
  }
  void choose_provisional_directions();
  /// Lets movers have their turn in order. Those that cannot move rest.
  void give_turns(std::vector<ProposedMove>& movers,
                  bool (Decisions::*move)(std::uint32_t, lattice::Direction));

  World& world_;
  Decisions& decisions_;
  std::vector<ProposedMove> pushed_;
  std::vector<ProposedMove> others_;
  std::vector<std::uint32_t> moved_;
  bool quiet_ = true;
};

}  // namespace clca::automaton
