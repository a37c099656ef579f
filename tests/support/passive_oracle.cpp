#include "support/passive_oracle.hpp"

#include <algorithm>
#include <optional>

#include "support/active_oracle.hpp"
#include "support/passive_verdict.hpp"

namespace clca::testing {

using grains::kRest;
using grains::Move;
using grains::Owner;
using grains::Particle;
using grains::Push;
using grains::State;
using lattice::Direction;
using lattice::Site;

namespace {

Move passive_choice(const Crowd& crowd, Direction gravity, Owner id, std::uint64_t bits) {
  std::map<int, std::vector<Direction>> by_score;
  for (const Direction direction : lattice::kDirections) {
    if (const auto score = Verdict(crowd, gravity, id, direction).score()) {
      by_score[*score].push_back(direction);
    }
  }
  if (by_score.empty()) {
    return kRest;
  }
  const std::vector<Direction>& best = by_score.begin()->second;
  return static_cast<Move>(best[random::below(bits, best.size())]);
}

/// The pushes by which `id` came onto particles that rested, in the order of its sites.
std::vector<Push> on_resting(const Crowd& crowd, Owner id) {
  std::vector<Push> result;
  const State& state = crowd.state();
  const Particle& own = crowd.particle(id);
  for (const lattice::Axial part : state.shape(own).sites()) {
    const Site site = own.site() + part;
    for (const Push& push : state.pushes) {
      const auto other = static_cast<Owner>(push.pushed);
      const Site wrapped{state.lattice.wrapped(site.column), site.row};
      if (push.pusher == id && crowd.particle(other).previous == kRest &&
          body_of(state, other).contains(wrapped) &&
          std::find(result.begin(), result.end(), push) == result.end()) {
        result.push_back(push);
      }
    }
  }
  return result;
}

/// Back from those that rest, or none if there are no such.
std::optional<Move> way_back(const Crowd& crowd, Owner id, std::uint64_t bits) {
  const std::vector<Push> resting = on_resting(crowd, id);
  if (resting.empty()) {
    return std::nullopt;
  }
  const Direction back = opposite(resting.front().direction);
  const int side = (bits & 1U) != 0 ? 1 : -1;
  for (const Direction way : {back, rotated(back, side), rotated(back, -side)}) {
    auto changes = crowd.changes(id, way);
    const bool serves = std::all_of(resting.begin(), resting.end(), [&](const Push& push) {
      const Change& change = changes[static_cast<Owner>(push.pushed)];
      return lattice::turns_between(opposite(push.direction), way) <= 1 &&
             change.sites_after < change.sites_before;
    });
    if (serves && crowd.is_free(id, way)) {
      return static_cast<Move>(way);
    }
  }
  return kRest;
}

Move active_choice(const Crowd& crowd, const ActiveOracle& rule, Owner id) {
  std::vector<Direction> free;
  for (const Direction direction : rule.candidates()) {
    if (crowd.is_free(id, direction)) {
      free.push_back(direction);
    }
  }
  return rule.provisional(static_cast<std::size_t>(id), free);
}

bool push_turn(Crowd& crowd, Direction gravity, Owner id, Direction direction) {
  const Verdict verdict(crowd, gravity, id, direction);
  if (!verdict.score()) {
    return false;
  }
  const std::vector<Push> fresh = verdict.new_pushes();
  crowd.move(id, direction);
  std::for_each(fresh.begin(), fresh.end(), [&](const Push& push) { crowd.record(push); });
  return true;
}

std::size_t move_particles(State& state, const automaton::Rules& rules) {
  Crowd crowd(state);
  const ActiveOracle rule{state, rules};
  std::vector<Wish> pushed;
  std::vector<Wish> others;
  for (std::size_t i = 0; i < state.particles.size(); ++i) {
    const auto id = static_cast<Owner>(i);
    const std::uint64_t bits = rule.draw(i, random::Purpose::passive);
    if (!crowd.pushes_onto(id).empty()) {
      pushed.push_back(rule.wish(i, passive_choice(crowd, rules.gravity, id, bits)));
      continue;
    }
    const std::optional<Move> back = way_back(crowd, id, bits);
    others.push_back(rule.wish(i, back ? *back : active_choice(crowd, rule, id)));
  }
  const auto rests = [&](const Wish& wish) {
    if (wish.move == kRest) {
      state.particles[wish.id].previous = kRest;
    }
    return wish.move == kRest;
  };
  std::erase_if(pushed, rests);
  std::erase_if(others, rests);
  std::size_t moved = 0;
  const auto done = [&](const Wish& wish, bool goes) {
    state.particles[wish.id].previous = goes ? wish.move : kRest;
    moved += goes ? 1U : 0U;
  };
  for (const Wish& wish : rule.in_order(pushed)) {
    done(wish, push_turn(crowd, rules.gravity, static_cast<Owner>(wish.id),
                         static_cast<Direction>(wish.move)));
  }
  for (const Wish& wish : rule.in_order(others)) {
    const auto direction = static_cast<Direction>(wish.move);
    const bool goes = crowd.is_free(static_cast<Owner>(wish.id), direction);
    if (goes) {
      crowd.move(static_cast<Owner>(wish.id), direction);
    }
    done(wish, goes);
  }
  return moved;
}

}  // namespace

WholeStep oracle_whole_step(State& state, const automaton::Rules& rules) {
  WholeStep step;
  step.walls = oracle_walls(state);
  step.moved = move_particles(state, rules);
  oracle_wait(state, step.moved > 0);
  ++state.step;
  return step;
}

}  // namespace clca::testing
