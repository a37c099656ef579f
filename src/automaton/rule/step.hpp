#pragma once
// One step of the automaton, as docs/model.md has it.

#include <algorithm>
#include <cstdint>
#include <vector>

#include "automaton/rule/active_rule.hpp"
#include "automaton/rule/moving_walls.hpp"
#include "automaton/rule/passive_rule.hpp"
#include "automaton/rule/update_order.hpp"
#include "automaton/rule/world.hpp"
#include "clca/automaton/automaton.hpp"
#include "grains/internal/source.hpp"

namespace clca::automaton {

/// The decisions about particles in a step, for ReferenceStep and Engine.
class Decisions {
 public:
  explicit Decisions(World& world)
      : world_(world),
        active_(world.rules, world.state.seed),
        order_(world.rules),
        passive_(world) {}

  /// The provisional direction of a particle, from the state as it is.
  grains::Move provisional(std::uint32_t id);
  /// Its place among the turns of this step, before it has moved.
  UpdateKey key(std::uint32_t id, grains::Move move) const {
    return order_.key(world_.state, id, move);
  }
  /// The turn of a particle that something has been pushed onto, and that of any other: it moves if
  /// it still can. False: it cannot.
  bool move_pushed(std::uint32_t id, lattice::Direction direction) {
    return passive_.move(id, direction);
  }
  bool move(std::uint32_t id, lattice::Direction direction);

  const ActiveRule& active() const { return active_; }

 private:
  World& world_;
  ActiveRule active_;
  UpdateOrder order_;
  PassiveRule passive_;
};

/// Points 3 and 4 of a step as the model is defined. Engine does the same faster.
class ReferenceStep {
 public:
  explicit ReferenceStep(World& world) : world_(world), decisions_(world) {}

  /// Returns how many particles moved.
  std::size_t advance();

  /// Particles that the last step looked at: all.
  std::size_t examined() const { return examined_; }
  /// True when no particle that overlaps had moved in the step before the last.
  bool was_quiet() const { return quiet_; }
  /// Calls `visit` with the id of each particle that moved in the last step.
  template <class Visit>
  void for_each_moved(Visit visit) const {
    std::for_each(moved_.begin(), moved_.end(), visit);
  }

 private:
  struct ProposedMove {
    UpdateKey key;
    lattice::Direction direction = lattice::Direction::down;
  };

  void choose_provisional_directions();
  /// Lets movers have their turn in order. Those that cannot move rest.
  void give_turns(std::vector<ProposedMove>& movers,
                  bool (Decisions::*move)(std::uint32_t, lattice::Direction));

  World& world_;
  Decisions decisions_;
  std::vector<ProposedMove> pushed_;
  std::vector<ProposedMove> others_;
  std::vector<std::uint32_t> moved_;
  std::size_t examined_ = 0;
  bool quiet_ = true;
};

/// Removes the particle if it lies wholly inside an outlet, and says whether it did.
bool remove_at_outlet(World& world, std::uint32_t id);

/// One step, "One step" of docs/model.md point by point. `particles` is a ReferenceStep or an
/// Engine.
template <class Particles>
StepReport one_step(World& world, const MovingWalls& walls, Particles& particles) {
  StepReport report;
  grains::State& state = world.state;

  // 1. Moving walls take the step that their motion asks for, if they can.
  walls.advance(world, report);

  // 2. Open sources emit.
  const std::size_t before = state.particles.size();
  const grains::SourceReport sources = grains::run_sources(state, world.occupancy);
  world.include_new(before);
  report.emitted = state.particles.size() - before;

  // 3. Every particle chooses a provisional direction. 4. Movers have their turn.
  report.moved = particles.advance();
  report.examined = particles.examined();

  // 5. Outlets remove particles that have moved and now lie wholly inside.
  if (!state.outlets.empty()) {
    const auto remove = [&](std::uint32_t id) {
      report.removed += remove_at_outlet(world, id) ? 1U : 0U;
    };
    particles.for_each_moved(remove);
    std::for_each(world.carried.begin(), world.carried.end(), remove);
    for (std::size_t id = before; id < state.particles.size(); ++id) {
      remove(static_cast<std::uint32_t>(id));
    }
  }

  // The end: settled when no later step can change anything.
  report.settled = report.moved == 0 && report.emitted == 0 && !sources.waiting &&
                   report.walls_moved == 0 && particles.was_quiet() && walls.is_still(world);
  MovingWalls::end_step(world, report.moved > 0);
  ++state.step;
  return report;
}

}  // namespace clca::automaton
