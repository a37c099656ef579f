#pragma once
// The active rule: where a particle would go by itself (Sakaguchi et al. 2001, Figs. 4 to 7).

#include <array>
#include <cstdint>
#include <span>

#include "clca/automaton/rules.hpp"
#include "clca/grains/footprint.hpp"
#include "clca/grains/state.hpp"
#include "clca/random/draw.hpp"

namespace clca::automaton {

class ActiveRule {
 public:
  ActiveRule(const Rules& rules, std::uint64_t seed)
      : candidates_(candidate_directions(rules)),
        inertia_(rules.inertia),
        scatter_(rules.scatter),
        seed_(seed) {
    for (const lattice::Direction direction : candidates_) {
      allowed_[index_of(direction)] = true;
    }
  }

  /// The provisional direction of particle `id` that did `previous` in the last step. `is_free`
  /// tells for a direction whether all its lead sites were free when the step began.
  template <class IsFree>
  [[gnu::always_inline]] grains::Move provisional(std::uint32_t id, grains::Move previous,
                                                  std::uint64_t step, IsFree is_free) const {
    if (!scatter_.is_zero()) {
      const auto bits = draw(id, step, random::Purpose::scatter);
      if (scatter_.accepts(bits)) {
        return any_free(id, step, is_free);
      }
    }
    const auto gravity = static_cast<grains::Move>(candidates_[0]);
    if (previous != grains::kRest && previous != gravity && !inertia_.is_zero() &&
        allowed_[previous] && is_free(static_cast<lattice::Direction>(previous)) &&
        inertia_.accepts(draw(id, step, random::Purpose::inertia))) {
      return previous;
    }
    if (is_free(candidates_[0])) {
      return gravity;
    }
    // Pairs at the same angle to gravity, the nearer ones first; a coin between equals.
    for (std::size_t pair = 1; pair < candidates_.size(); pair += 2) {
      const grains::Move move = one_of_pair(id, step, pair, is_free);
      if (move != grains::kRest) {
        return move;
      }
    }
    return grains::kRest;
  }

 private:
  std::uint64_t draw(std::uint32_t id, std::uint64_t step, random::Purpose purpose) const {
    return random::draw(seed_, step, id, purpose);
  }

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
    return free[random::below(draw(id, step, random::Purpose::scatter_direction), count)];
  }

  template <class IsFree>
  grains::Move one_of_pair(std::uint32_t id, std::uint64_t step, std::size_t pair,
                           IsFree is_free) const {
    const lattice::Direction first = candidates_[pair];
    if (pair + 1 == candidates_.size()) {
      return is_free(first) ? static_cast<grains::Move>(first) : grains::kRest;
    }
    const lattice::Direction second = candidates_[pair + 1];
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

  std::span<const lattice::Direction> candidates_;
  std::array<bool, lattice::kDirectionCount> allowed_{};
  random::Probability inertia_;
  random::Probability scatter_;
  std::uint64_t seed_;
};

}  // namespace clca::automaton
