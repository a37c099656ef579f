#include "clca/automaton/rules.hpp"

#include <algorithm>
#include <stdexcept>

namespace clca::automaton {

using lattice::Direction;

std::span<const Direction> candidate_directions(const Rules& rules) {
  static constexpr auto kOrdered = [] {
    std::array<std::array<Direction, lattice::kDirectionCount>, lattice::kDirectionCount> table{};
    for (const Direction gravity : lattice::kDirections) {
      constexpr std::array<int, lattice::kDirectionCount> kTurns = {0, 1, -1, 2, -2, 3};
      for (std::size_t i = 0; i < kTurns.size(); ++i) {
        table[index_of(gravity)][i] = rotated(gravity, kTurns[i]);
      }
    }
    return table;
  }();
  const auto& ordered = kOrdered[index_of(rules.gravity)];
  return {ordered.data(), rules.candidates == Candidates::all ? ordered.size() : 3};
}

void check_rules(const Rules& rules) {
  if (index_of(rules.gravity) >= lattice::kDirectionCount) {
    throw std::invalid_argument("gravity has no direction");
  }
  std::array<UpdateClass, 3> classes = rules.update_priority;
  std::sort(classes.begin(), classes.end());
  if (classes != std::array{UpdateClass::rest, UpdateClass::inertia, UpdateClass::gravity}) {
    throw std::invalid_argument("the update priority does not name each class once");
  }
}

}  // namespace clca::automaton
