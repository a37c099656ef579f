#include "support/oracle.hpp"

#include <algorithm>
#include <map>
#include <vector>

#include "clca/random/draw.hpp"

namespace clca::testing {

namespace {

using automaton::kRest;
using automaton::Move;
using automaton::Particle;
using automaton::State;
using lattice::Direction;
using lattice::Site;
using random::Purpose;

constexpr int kWall = -1;

/// Who stands where; sites outside the box are wall.
class Map {
 public:
  explicit Map(const State& state) : state_(state) {
    for (const auto& wall : state.walls) {
      for (const Site site : wall.sites) {
        if (wall.present) {
          owners_[site] = kWall;
        }
      }
    }
    for (std::size_t id = 0; id < state.particles.size(); ++id) {
      put(state.particles[id], static_cast<int>(id));
    }
  }

  bool can_go(const Particle& particle, int id, Direction direction) const {
    const auto& parts = state_.shape(particle).sites();
    return std::all_of(parts.begin(), parts.end(), [&](lattice::Axial part) {
      const Site site = wrapped(particle.site() + part + unit(direction));
      const auto found = owners_.find(site);
      return state_.lattice.contains(site) && (found == owners_.end() || found->second == id);
    });
  }

  void move(Particle& particle, int id, Direction direction) {
    for (const lattice::Axial part : state_.shape(particle).sites()) {
      owners_.erase(wrapped(particle.site() + part));
    }
    const Site target = particle.site() + unit(direction);
    particle.column = target.column;
    particle.row = target.row;
    put(particle, id);
  }

 private:
  Site wrapped(Site site) const { return {state_.lattice.wrapped(site.column), site.row}; }
  void put(const Particle& particle, int id) {
    for (const lattice::Axial part : state_.shape(particle).sites()) {
      owners_[wrapped(particle.site() + part)] = id;
    }
  }

  const State& state_;
  std::map<Site, int> owners_;
};

struct Rule {
  const State& state;

  std::uint64_t draw(std::size_t id, Purpose purpose) const {
    return random::draw(state.seed, state.step, static_cast<std::uint32_t>(id), purpose);
  }

  std::vector<Direction> candidates() const {
    const Direction g = state.rules.gravity;
    std::vector<Direction> all = {g, rotated(g, 1), rotated(g, -1)};
    if (state.rules.candidates == automaton::Candidates::all) {
      for (const int turn : {2, -2, 3}) {
        all.push_back(rotated(g, turn));
      }
    }
    return all;
  }

  Move provisional(std::size_t id, const std::vector<Direction>& free) const {
    const auto is_free = [&](Direction d) {
      return std::find(free.begin(), free.end(), d) != free.end();
    };
    const Particle& particle = state.particles[id];
    const Direction g = state.rules.gravity;
    if (free.empty()) {
      return kRest;
    }
    if (random::Probability(state.rules.scatter).accepts(draw(id, Purpose::scatter))) {
      return static_cast<Move>(
          free[random::below(draw(id, Purpose::scatter_direction), free.size())]);
    }
    if (particle.previous != kRest && is_free(static_cast<Direction>(particle.previous)) &&
        random::Probability(state.rules.inertia).accepts(draw(id, Purpose::inertia))) {
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

  std::size_t class_of(Move previous, Move move) const {
    for (std::size_t rank = 0; rank < 3; ++rank) {
      switch (state.rules.update_priority[rank]) {
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
          if (move == static_cast<Move>(state.rules.gravity)) {
            return rank;
          }
          break;
      }
    }
    return 3;
  }

  /// The order of the directions within a class: pairs by a coin.
  std::vector<Move> passes(std::size_t rank) const {
    std::vector<Direction> order = candidates();
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
};

struct Wish {
  std::size_t id;
  Move move;
  std::size_t rank;
};

/// Particles in the order of their turns.
std::vector<Wish> in_order(const Rule& rule, std::vector<Wish> wishes) {
  if (rule.state.rules.ties == automaton::Ties::particle) {
    std::sort(wishes.begin(), wishes.end(), [&](const Wish& a, const Wish& b) {
      return std::tuple(a.rank, rule.draw(a.id, Purpose::tie), a.id) <
             std::tuple(b.rank, rule.draw(b.id, Purpose::tie), b.id);
    });
    return wishes;
  }
  std::vector<Wish> ordered;
  for (std::size_t rank = 0; rank < 4; ++rank) {
    for (const Move move : rule.passes(rank)) {
      std::copy_if(wishes.begin(), wishes.end(), std::back_inserter(ordered),
                   [&](const Wish& wish) { return wish.rank == rank && wish.move == move; });
    }
  }
  return ordered;
}

}  // namespace

std::size_t oracle_step(State& state) {
  Map map(state);
  const Rule rule{state};
  std::vector<Wish> wishes;
  for (std::size_t id = 0; id < state.particles.size(); ++id) {
    std::vector<Direction> free;
    for (const Direction direction : rule.candidates()) {
      if (map.can_go(state.particles[id], static_cast<int>(id), direction)) {
        free.push_back(direction);
      }
    }
    const Move move = rule.provisional(id, free);
    if (move != kRest) {
      wishes.push_back({id, move, rule.class_of(state.particles[id].previous, move)});
    } else {
      state.particles[id].previous = kRest;
    }
  }
  std::size_t moved = 0;
  for (const Wish& wish : in_order(rule, std::move(wishes))) {
    Particle& particle = state.particles[wish.id];
    const auto direction = static_cast<Direction>(wish.move);
    const bool goes = map.can_go(particle, static_cast<int>(wish.id), direction);
    if (goes) {
      map.move(particle, static_cast<int>(wish.id), direction);
      ++moved;
    }
    particle.previous = goes ? wish.move : kRest;
  }
  ++state.step;
  return moved;
}

long long potential(const State& state) {
  const Eigen::Vector2d up = lattice::position(unit(opposite(state.rules.gravity)));
  long long sum = 0;
  for (const Particle& particle : state.particles) {
    sum += std::llround(2 * lattice::position(particle.site()).dot(up));
  }
  return sum;
}

}  // namespace clca::testing
