// The order in which movers have their turn.

#include <algorithm>

#include "automaton/rule/step.hpp"
#include "clca/random/draw.hpp"

namespace clca::automaton {

namespace {

/// The first class that fits.
std::uint64_t class_of(const Rules& rules, grains::Move previous, grains::Move move) {
  const auto fits = [&](UpdateClass update_class) {
    switch (update_class) {
      case UpdateClass::rest:
        return previous == grains::kRest;
      case UpdateClass::inertia:
        return previous == move;
      case UpdateClass::gravity:
        return move == static_cast<grains::Move>(rules.gravity);
    }
    return false;
  };
  const auto& classes = rules.update_priority;
  return static_cast<std::uint64_t>(std::ranges::find_if(classes, fits) - classes.begin());
}

/// Ties::direction: gravity first, then pairs at the same angle to it, each in the order of a coin
/// for the class and the step.
std::uint64_t direction_tie(const Rules& rules, const grains::State& state, grains::Move move,
                            std::uint64_t update_class) {
  const auto direction = static_cast<lattice::Direction>(move);
  const auto angle = static_cast<std::uint64_t>(lattice::sixths_between(rules.gravity, direction));
  const bool clockwise = rotated(rules.gravity, static_cast<int>(angle)) == direction;
  const auto coin = random::draw(state.seed, state.step, static_cast<std::uint32_t>(update_class),
                                 random::Purpose::direction_order);
  const bool clockwise_first = (coin & 1U) == 0;
  return 2 * angle + (clockwise == clockwise_first ? 0 : 1);
}

}  // namespace

UpdateKey update_key(const Rules& rules, const grains::State& state, std::uint32_t id,
                     grains::Move move) {
  const std::uint64_t update_class = class_of(rules, state.particles[id].previous, move);
  switch (rules.ties) {
    case Ties::particle:
      return {update_class, random::draw(state.seed, state.step, id, random::Purpose::tie), id};
    case Ties::direction:
      return {update_class, direction_tie(rules, state, move, update_class), id};
  }
  return {update_class, 0, id};
}

}  // namespace clca::automaton
