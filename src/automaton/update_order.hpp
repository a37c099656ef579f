#pragma once
// The order in which movers that want the same site have their turn.

#include <array>
#include <cstddef>
#include <cstdint>
#include <tuple>

#include "clca/automaton/rules.hpp"
#include "clca/grains/state.hpp"

namespace clca::automaton {

/// Place in the total order of one step: class, then tie, then id.
struct UpdateKey {
  std::uint64_t rank = 0;
  std::uint64_t tie = 0;
  std::uint32_t id = 0;

  auto operator<=>(const UpdateKey&) const = default;
};

class UpdateOrder {
 public:
  /// Ranks are below.
  static constexpr std::size_t kRanks = std::tuple_size_v<decltype(Rules::update_priority)> + 1;

  UpdateOrder(const Rules& rules, std::uint64_t seed);

  /// The key of particle `id` that did `previous` in the last step and now wants to do `move`.
  UpdateKey key(std::uint32_t id, grains::Move previous, grains::Move move,
                std::uint64_t step) const;

 private:
  std::uint64_t class_rank(grains::Move previous, grains::Move move) const;
  /// Gravity first; of a pair at the same angle the one that a coin per step and class names.
  std::uint64_t direction_tie(grains::Move move, std::uint64_t rank, std::uint64_t step) const;

  Rules rules_;
  std::array<std::uint64_t, lattice::kDirectionCount> place_{};  // from gravity on
  std::uint64_t seed_;
};

}  // namespace clca::automaton
