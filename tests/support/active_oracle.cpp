#include "support/active_oracle.hpp"

#include <algorithm>
#include <tuple>

namespace clca::testing {

using grains::kRest;
using grains::Move;
using grains::Particle;
using lattice::Direction;
using random::Purpose;

namespace {

/// Gravity, then pairs at the same angle to it, then its opposite.
std::vector<Direction> around(Direction gravity, const std::vector<int>& turns) {
  std::vector<Direction> directions;
  for (const int turn : turns) {
    directions.push_back(rotated(gravity, turn));
  }
  return directions;
}

}  // namespace

std::uint64_t ActiveOracle::draw(std::size_t id, Purpose purpose) const {
  return random::draw(state.seed, state.step, static_cast<std::uint32_t>(id), purpose);
}

std::vector<Direction> ActiveOracle::candidates() const {
  const bool all = rules.candidates == automaton::Candidates::all;
  return around(rules.gravity, all ? std::vector{0, 1, -1, 2, -2, 3} : std::vector{0, 1, -1});
}

Move ActiveOracle::provisional(std::size_t id, const std::vector<Direction>& free) const {
  const auto is_free = [&](Direction d) {
    return std::find(free.begin(), free.end(), d) != free.end();
  };
  const Particle& particle = state.particles[id];
  const Direction g = rules.gravity;
  if (free.empty()) {
    return kRest;
  }
  if (random::Probability(rules.scatter).accepts(draw(id, Purpose::scatter))) {
    return static_cast<Move>(
        free[random::below(draw(id, Purpose::scatter_direction), free.size())]);
  }
  if (particle.previous != kRest && is_free(static_cast<Direction>(particle.previous)) &&
      random::Probability(rules.inertia).accepts(draw(id, Purpose::inertia))) {
    return particle.previous;
  }
  if (is_free(g)) {
    return static_cast<Move>(g);
  }
  for (const int turn : {1, 2}) {
    const Direction right = rotated(g, turn);
    const Direction left = rotated(g, -turn);
    if (is_free(right) && is_free(left)) {
      return static_cast<Move>((draw(id, Purpose::coin) & 1U) != 0 ? right : left);
    }
    if (is_free(right) || is_free(left)) {
      return static_cast<Move>(is_free(right) ? right : left);
    }
  }
  return static_cast<Move>(opposite(g));
}

Wish ActiveOracle::wish(std::size_t id, Move move) const {
  return {id, move, class_of(state.particles[id].previous, move)};
}

std::size_t ActiveOracle::class_of(Move previous, Move move) const {
  for (std::size_t rank = 0; rank < 3; ++rank) {
    switch (rules.update_priority[rank]) {
      case automaton::UpdateClass::rest:
        if (previous == kRest) {
          return rank;
        }
        break;
      case automaton::UpdateClass::inertia:
        if (previous == move) {
          return rank;
        }
        break;
      case automaton::UpdateClass::gravity:
        if (move == static_cast<Move>(rules.gravity)) {
          return rank;
        }
        break;
    }
  }
  return 3;
}

// The order of the directions within a class: pairs by a coin. All six, since a push may lead
// anywhere.
std::vector<Move> ActiveOracle::passes(std::size_t rank) const {
  std::vector<Direction> order = around(rules.gravity, {0, 1, -1, 2, -2, 3});
  const bool swap = (draw(rank, Purpose::direction_order) & 1U) != 0;
  for (std::size_t pair = 1; swap && pair + 1 < order.size(); pair += 2) {
    std::swap(order[pair], order[pair + 1]);
  }
  std::vector<Move> moves;
  for (const Direction direction : order) {
    moves.push_back(static_cast<Move>(direction));
  }
  return moves;
}

std::vector<Wish> ActiveOracle::in_order(std::vector<Wish> wishes) const {
  if (rules.ties == automaton::Ties::particle) {
    std::sort(wishes.begin(), wishes.end(), [&](const Wish& a, const Wish& b) {
      return std::tuple(a.rank, draw(a.id, Purpose::tie), a.id) <
             std::tuple(b.rank, draw(b.id, Purpose::tie), b.id);
    });
    return wishes;
  }
  std::sort(wishes.begin(), wishes.end(), [](const Wish& a, const Wish& b) { return a.id < b.id; });
  std::vector<Wish> ordered;
  for (std::size_t rank = 0; rank < 4; ++rank) {
    for (const Move move : passes(rank)) {
      std::copy_if(wishes.begin(), wishes.end(), std::back_inserter(ordered),
                   [&](const Wish& wish) { return wish.rank == rank && wish.move == move; });
    }
  }
  return ordered;
}

}  // namespace clca::testing
