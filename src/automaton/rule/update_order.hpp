#pragma once
// The order in which movers have their turn.

#include <cstddef>
#include <cstdint>
#include <tuple>

#include "clca/automaton/rules.hpp"
#include "clca/grains/state.hpp"

namespace clca::automaton {

/// Rank in the total order of one step, the smallest first.
struct UpdateKey {
  std::uint64_t update_class = 0;  ///< rank in Rules::update_priority; behind all: in none
  std::uint64_t tie = 0;
  std::uint32_t id = 0;

  auto operator<=>(const UpdateKey&) const = default;
};

class UpdateOrder {
 public:
  explicit UpdateOrder(const Rules& rules) : rules_(rules) {}

  /// The key of particle `id`, which has not moved yet in this step and is to do `move`.
  UpdateKey key(const grains::State& state, std::uint32_t id, grains::Move move) const;

 private:
  /// The first class that fits.
  std::uint64_t class_of(grains::Move previous, grains::Move move) const;
  /// Ties::direction: gravity first, then pairs at the same angle to it, each in the order of a
  /// coin for the class and the step.
  std::uint64_t direction_tie(const grains::State& state, grains::Move move,
                              std::uint64_t update_class) const;

  Rules rules_;
};

}  // namespace clca::automaton
