#include "automaton/rule/decisions.hpp"

#include "automaton/rule/retreat.hpp"

namespace clca::automaton {

grains::Move Decisions::provisional(std::uint32_t id) {
  // The passive rule, for those that something has been pushed onto.
  if (!PushList::onto(world_.state, id).empty()) {
    return passive_.provisional(id);
  }
  // Back from those that it has pushed itself, where they rest.
  if (const auto back = retreat(world_, id)) {
    return *back;
  }
  // Else the active rule.
  return active_.provisional(
      id, world_.state.particles[id].previous, world_.state.step,
      [&](lattice::Direction direction) { return is_free(world_, id, direction); });
}

bool Decisions::move(std::uint32_t id, lattice::Direction direction) {
  if (!is_free(world_, id, direction)) {
    return false;
  }
  world_.move(id, direction);
  return true;
}

}  // namespace clca::automaton
