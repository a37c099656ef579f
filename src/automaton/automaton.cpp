#include "clca/automaton/automaton.hpp"

#include <memory>
#include <stdexcept>
#include <utility>

#include "automaton/engine/engine.hpp"
#include "automaton/rule/step.hpp"

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
  return SiteReservations::bytes_for(index_count) +
         grains::kListRoom *
             (StripWorker::kListedBytes * particles + StripWorker::kAwakeBytes * awake);
}

Automaton::Automaton(grains::State state, const Rules& rules, const Options& options)
    : Model(make_steps(std::move(state), rules, options)) {}

const Rules& Automaton::rules() const {
  return static_cast<const Steps&>(mechanics()).rules();
}

}  // namespace clca::automaton
