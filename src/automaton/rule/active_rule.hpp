#pragma once
// The active rule: where a particle goes by itself (Sakaguchi et al. 2001, Figs. 4 to 7).

#include <array>
#include <cstdint>
#include <vector>

#include "clca/automaton/automaton.hpp"
#include "clca/grains/state.hpp"
#include "clca/random/draw.hpp"

namespace clca::automaton {

/// Pure: a decision depends on the arguments and the draws of its particle and step only.
class ActiveRule {
 public:
  ActiveRule(const Rules& rules, std::uint64_t seed)
      : candidates_(candidate_directions(rules)),
        inertia_(rules.inertia),
        scatter_(rules.scatter),
        seed_(seed) {
    for (const lattice::Direction direction : candidates_) {
      is_candidate_[index_of(direction)] = true;
    }
  }

  /// Gravity's first, see candidate_directions().
  const std::vector<lattice::Direction>& candidates() const { return candidates_; }

  /// The provisional direction of particle `id` that did `previous` in the last step. `is_free`
  /// tells for a direction whether all its lead sites were free when the step began.
  template <class IsFree>
  [[gnu::always_inline]] grains::Move provisional_move(std::uint32_t id, grains::Move previous,
                                                       std::uint64_t step, IsFree is_free) const {
    // With probability scatter: any free candidate, all alike.
    if (happens(scatter_, id, step, random::Purpose::scatter)) {
      return any_free(id, step, is_free);
    }
    // With probability inertia: the previous direction, if it is a free candidate. Where that is
    // gravity's, the result is the same without a draw.
    const lattice::Direction gravity = candidates_.front();
    if (previous != grains::kRest && previous != static_cast<grains::Move>(gravity) &&
        is_candidate_[previous] && is_free(static_cast<lattice::Direction>(previous)) &&
        happens(inertia_, id, step, random::Purpose::inertia)) {
      return previous;
    }
    // Along gravity, if that is free.
    if (is_free(gravity)) {
      return static_cast<grains::Move>(gravity);
    }
    // The pairs at the same angle to gravity, the nearer one first.
    std::size_t next = 1;
    for (; next + 1 < candidates_.size(); next += 2) {
      const grains::Move move =
          one_of_pair(id, step, candidates_[next], candidates_[next + 1], is_free);
      if (move != grains::kRest) {
        return move;
      }
    }
    // Against gravity, where that is a candidate.
    const bool rises = next < candidates_.size() && is_free(candidates_[next]);
    return rises ? static_cast<grains::Move>(candidates_[next]) : grains::kRest;
  }

 private:
  std::uint64_t draw(std::uint32_t id, std::uint64_t step, random::Purpose purpose) const {
    return random::draw(seed_, step, id, purpose);
  }
  bool happens(random::Probability probability, std::uint32_t id, std::uint64_t step,
               random::Purpose purpose) const {
    return !probability.is_zero() && probability.accepts(draw(id, step, purpose));
  }

  /// Each free candidate with equal chances; kRest if there is none.
  template <class IsFree>
  grains::Move any_free(std::uint32_t id, std::uint64_t step, IsFree is_free) const {
    std::array<grains::Move, lattice::kDirectionCount> free{};
    std::size_t count = 0;
    for (const lattice::Direction direction : candidates_) {
      if (is_free(direction)) {
        free[count++] = static_cast<grains::Move>(direction);
      }
    }
    if (count == 0) {
      return grains::kRest;
    }
    return free[random::uniform_below(draw(id, step, random::Purpose::scatter_direction), count)];
  }

  /// Where both are free a coin decides.
  template <class IsFree>
  grains::Move one_of_pair(std::uint32_t id, std::uint64_t step, lattice::Direction first,
                           lattice::Direction second, IsFree is_free) const {
    const bool first_free = is_free(first);
    const bool second_free = is_free(second);
    if (first_free && second_free) {
      const bool heads = (draw(id, step, random::Purpose::coin) & 1U) != 0;
      return static_cast<grains::Move>(heads ? first : second);
    }
    if (first_free || second_free) {
      return static_cast<grains::Move>(first_free ? first : second);
    }
    return grains::kRest;
  }

  std::vector<lattice::Direction> candidates_;
  std::array<bool, lattice::kDirectionCount> is_candidate_{};
  random::Probability inertia_;
  random::Probability scatter_;
  std::uint64_t seed_;
};

}  // namespace clca::automaton
