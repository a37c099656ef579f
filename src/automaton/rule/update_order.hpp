#pragma once
// The order in which movers have their turn.

#include <cstdint>

#include "clca/automaton/automaton.hpp"
#include "clca/grains/state.hpp"

namespace clca::automaton {

/// Rank in the total order of one step, the smallest first.
struct UpdateKey {
  std::uint64_t update_class = 0;  ///< rank in Rules::update_priority; behind all: in none
  std::uint64_t tie = 0;
  std::uint32_t id = 0;

  auto operator<=>(const UpdateKey&) const = default;
};

/// The key of particle `id`, which has not moved yet in this step and is to do `move`.
UpdateKey update_key(const Rules& rules, const grains::State& state, std::uint32_t id,
                     grains::Move move);

}  // namespace clca::automaton
