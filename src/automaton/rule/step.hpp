#pragma once
// One step of the automaton, as docs/model.md has it.

#include <cstdint>
#include <span>
#include <vector>

#include "automaton/rule/active_rule.hpp"
#include "automaton/rule/world.hpp"
#include "clca/grains/model.hpp"
#include "grains/internal/mechanics.hpp"

namespace clca::automaton {

/// Rank in the total order of one step, the smallest first.
struct UpdateKey {
  std::uint64_t update_class = 0;  ///< rank in Rules::update_priority; behind all: in none
  std::uint64_t tie = 0;           ///< a draw, or the angle to gravity and a coin: see TieBreaking
  std::uint32_t id = 0;

  auto operator<=>(const UpdateKey&) const = default;
};

/// The key of particle `id`, which has not moved yet in this step and is to do `move`.
UpdateKey update_key(const Rules& rules, const grains::State& state, std::uint32_t id,
                     grains::Move move);

// The decisions about particles.

/// The provisional direction of a particle, from the state as it is.
grains::Move provisional_move(const World& world, const ActiveRule& active, std::uint32_t id);

/// The turn of a particle onto which something had been pushed when it chose: moves it and records
/// whom it pushes, if that is still allowed. Returns whether it moved.
bool try_move_pushed(World& world, std::uint32_t id, lattice::Direction direction);

/// The turn of a particle onto which nothing had been pushed when it chose: moves it if that is
/// still possible. Returns whether it moved.
bool try_move_by_itself(World& world, std::uint32_t id, lattice::Direction direction);

/// Whether the particle would share no site with `owner` after one of these moves.
bool can_leave(const World& world, const grains::Particle& particle, grains::Owner owner,
               std::span<const lattice::Direction> directions);

/// A particle that has chosen to move.
struct ProposedMove {
  UpdateKey key;
  lattice::Direction direction = lattice::Direction::down;
};

/// "One step" of docs/model.md, but for points 3 and 4: the particles' own moves.
class AutomatonMechanics : public grains::Mechanics {
 public:
  /// Throws std::invalid_argument if the state is not valid (see grains::Occupancy).
  AutomatonMechanics(grains::State initial, const Rules& rules);

  const Rules& rules() const { return world_.rules; }

  grains::Box& box() final { return box_; }
  lattice::Direction down() const final { return world_.rules.gravity; }
  bool can_deposit() const final { return world_.rules.gravity == lattice::Direction::down; }
  void before_sources() final;
  void on_added(std::size_t first) final { world_.include_new(first); }
  bool advance(grains::StepReport& report) final;
  std::vector<std::uint32_t> moved_ids() const final;
  void on_removing(std::uint32_t id) final { world_.prepare_removal(id); }
  void on_reloaded() final { world_.reload(); }

 private:
  grains::State state_;
  grains::Box box_;
  bool wall_moved_ = false;  // in this step

 protected:
  struct Movers {
    std::vector<ProposedMove> pushed;  ///< something has been pushed onto these
    std::vector<ProposedMove> others;
  };

  /// Points 3 and 4, after moved_ has been cleared. Returns how many particles moved.
  virtual std::size_t move_particles() = 0;
  /// Appends the particles that moved by themselves in this step and are not in moved_.
  virtual void append_moved(std::vector<std::uint32_t>& /*ids*/) const {}

  /// Each of these particles chooses a provisional direction, from the state at this moment alone.
  Movers chosen_moves(std::span<const std::uint32_t> ids);
  /// Lets movers have their turn in order. Those that cannot move rest.
  void give_turns(std::vector<ProposedMove>& movers,
                  bool (*move)(World&, std::uint32_t, lattice::Direction));

  // NOLINTBEGIN(readability-identifier-naming): as private ones, beside functions of their names
  World world_;
  ActiveRule active_;
  std::vector<std::uint32_t> moved_;  // in this step, by give_turns()
  bool overlapping_rested_ = true;    // none of those that overlap had moved in the step before
  // NOLINTEND(readability-identifier-naming)
};

/// Points 3 and 4 of a step as the model is defined. Engine does the same faster.
class ReferenceMechanics final : public AutomatonMechanics {
 public:
  using AutomatonMechanics::AutomatonMechanics;

 private:
  std::size_t move_particles() override;
};

}  // namespace clca::automaton
