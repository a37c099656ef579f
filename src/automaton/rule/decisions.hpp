#pragma once
// The decisions about particles in a step.

#include <cstdint>

#include "automaton/rule/active_rule.hpp"
#include "automaton/rule/passive_rule.hpp"
#include "automaton/rule/update_order.hpp"
#include "automaton/rule/world.hpp"

namespace clca::automaton {

/// For Reference and Engine.
class Decisions {
 public:
  explicit Decisions(World& world)
      : world_(world),
        active_(world.rules, world.state.seed),
        order_(world.rules),
        passive_(world) {}

  /// The provisional direction of a particle, from the state as it is.
  grains::Move provisional(std::uint32_t id);
  /// Its position among the turns of this step, before it has moved.
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

}  // namespace clca::automaton
