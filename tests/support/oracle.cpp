#include "support/oracle.hpp"

#include <algorithm>
#include <map>
#include <vector>

#include "support/active_oracle.hpp"

namespace clca::testing {

namespace {

using grains::kRest;
using grains::Move;
using grains::Particle;
using grains::State;
using lattice::Direction;
using lattice::Site;

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

}  // namespace

std::size_t oracle_step(State& state, const automaton::Rules& rules) {
  Map map(state);
  const ActiveOracle rule{state, rules};
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
      wishes.push_back(rule.wish(id, move));
    } else {
      state.particles[id].previous = kRest;
    }
  }
  std::size_t moved = 0;
  for (const Wish& wish : rule.in_order(std::move(wishes))) {
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

long long potential(const State& state, const automaton::Rules& rules) {
  const Eigen::Vector2d up = lattice::position(unit(opposite(rules.gravity)));
  long long sum = 0;
  for (const Particle& particle : state.particles) {
    sum += std::llround(2 * lattice::position(particle.site()).dot(up));
  }
  return sum;
}

}  // namespace clca::testing
