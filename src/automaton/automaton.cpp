#include "clca/automaton/automaton.hpp"

#include <algorithm>
#include <memory>
#include <utility>

#include "automaton/engine/engine.hpp"
#include "automaton/rule/step.hpp"
#include "lattice/internal/require.hpp"

namespace clca::automaton {

namespace {

std::unique_ptr<grains::Mechanics> make_steps(grains::State state, const Rules& rules,
                                              const Options& options) {
  check_valid(options);
  check_rules(rules);
  check_valid(state);
  if (options.reference) {
    return std::make_unique<Reference>(std::move(state), rules);
  }
  return std::make_unique<Engine>(std::move(state), rules, options);
}

}  // namespace

double step_bytes(double index_count, double particles, double awake) {
  // At the beginning all are looked at.
  return 2 * grains::Bitboard::bytes_for(index_count) +
         grains::kListRoom *
             (StripWorker::kListedBytes * particles + StripWorker::kAwakeBytes * awake);
}

Automaton::Automaton(grains::State state, const Rules& rules, const Options& options)
    : Model(make_steps(std::move(state), rules, options)) {}

const Rules& Automaton::rules() const {
  return static_cast<const Steps&>(mechanics()).rules();
}

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
  require(index_of(rules.gravity) < lattice::kDirectionCount, "gravity has no direction");
  std::array<UpdateClass, 3> classes = rules.update_priority;
  std::ranges::sort(classes);
  require(classes == std::array{UpdateClass::rest, UpdateClass::inertia, UpdateClass::gravity},
          "the update priority does not name each class once");
}

}  // namespace clca::automaton
