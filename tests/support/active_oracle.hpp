#pragma once
// The active rule and the order of turns, written down as plainly as they can be.

#include <cstdint>
#include <vector>

#include "clca/automaton/rules.hpp"
#include "clca/grains/state.hpp"
#include "clca/random/draw.hpp"

namespace clca::testing {

/// A particle that wants to move, and the class of its turn.
struct Wish {
  std::size_t id;
  grains::Move move;
  std::size_t rank;
};

struct ActiveOracle {
  const grains::State& state;
  const automaton::Rules& rules;

  std::uint64_t draw(std::size_t id, random::Purpose purpose) const;
  /// Directions a particle may take by itself.
  std::vector<lattice::Direction> candidates() const;
  /// Where a particle wants to go that is free to go in the candidates `free`.
  grains::Move provisional(std::size_t id, const std::vector<lattice::Direction>& free) const;
  Wish wish(std::size_t id, grains::Move move) const;
  /// Movers in the order of their turns.
  std::vector<Wish> in_order(std::vector<Wish> wishes) const;

 private:
  std::size_t class_of(grains::Move previous, grains::Move move) const;
  std::vector<grains::Move> passes(std::size_t rank) const;
};

}  // namespace clca::testing
