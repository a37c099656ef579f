#include "clca/automaton/automaton.hpp"

#include <algorithm>
#include <cstdlib>
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
  if (options.use_reference) {
    return std::make_unique<ReferenceMechanics>(std::move(state), rules);
  }
  return std::make_unique<Engine>(std::move(state), rules, options);
}

}  // namespace

double step_bytes(double index_count, double particles, double awake) {
  // At the beginning all are looked at.
  return 2 * grains::Bitboard::bytes_for(index_count) +
         grains::kListCapacityRatio *
             (StripWorker::kListedBytes * particles + StripWorker::kAwakeBytes * awake);
}

Automaton::Automaton(grains::State state, const Rules& rules, const Options& options)
    : Model(make_steps(std::move(state), rules, options)) {}

const Rules& Automaton::rules() const {
  return static_cast<const AutomatonMechanics&>(mechanics()).rules();
}

std::vector<lattice::Direction> candidate_directions(const Rules& rules) {
  std::vector<lattice::Direction> result;
  for (const int turn : {0, 1, -1, 2, -2, 3}) {
    if (rules.candidates == CandidateDirections::all || std::abs(turn) <= 1) {
      result.push_back(rotated(rules.gravity, turn));
    }
  }
  return result;
}

void check_rules(const Rules& rules) {
  require(index_of(rules.gravity) < lattice::kDirectionCount, "gravity has no direction");
  std::array<UpdateClass, 3> classes = rules.update_priority;
  std::ranges::sort(classes);
  require(classes == std::array{UpdateClass::rest, UpdateClass::inertia, UpdateClass::gravity},
          "the update priority does not name each class once");
}

}  // namespace clca::automaton
