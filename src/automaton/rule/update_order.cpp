#include "automaton/rule/update_order.hpp"

#include <algorithm>

#include "clca/random/draw.hpp"

namespace clca::automaton {

UpdateKey UpdateOrder::key(const grains::State& state, std::uint32_t id, grains::Move move) const {
  const std::uint64_t update_class = class_of(state.particles[id].previous, move);
  switch (rules_.ties) {
    case Ties::particle:
      return {update_class, random::draw(state.seed, state.step, id, random::Purpose::tie), id};
    case Ties::direction:
      return {update_class, direction_tie(state, move, update_class), id};
  }
  return {update_class, 0, id};
}

std::uint64_t UpdateOrder::class_of(grains::Move previous, grains::Move move) const {
  const auto fits = [&](UpdateClass update_class) {
    switch (update_class) {
      case UpdateClass::rest:
        return previous == grains::kRest;
      case UpdateClass::inertia:
        return previous == move;
      case UpdateClass::gravity:
        return move == static_cast<grains::Move>(rules_.gravity);
    }
    return false;
  };
  const auto& classes = rules_.update_priority;
  return static_cast<std::uint64_t>(std::find_if(classes.begin(), classes.end(), fits) -
                                    classes.begin());
}

std::uint64_t UpdateOrder::direction_tie(const grains::State& state, grains::Move move,
                                         std::uint64_t update_class) const {
  const auto direction = static_cast<lattice::Direction>(move);
  const auto angle = static_cast<std::uint64_t>(lattice::turns_between(rules_.gravity, direction));
  const bool clockwise = rotated(rules_.gravity, static_cast<int>(angle)) == direction;
  const auto coin = random::draw(state.seed, state.step, static_cast<std::uint32_t>(update_class),
                                 random::Purpose::direction_order);
  const bool clockwise_first = (coin & 1U) == 0;
  return 2 * angle + (clockwise == clockwise_first ? 0 : 1);
}

}  // namespace clca::automaton
