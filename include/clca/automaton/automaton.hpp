#pragma once
// The connected lattice cellular automaton: one step of the priority-ordered update.

#include "clca/automaton/rules.hpp"
#include "clca/grains/model.hpp"

namespace clca::automaton {

using grains::Options;

/// Bytes that steps need besides the state and its occupancy, for a lattice with this
/// index_count(). `awake`: particles that may move in a step.
double step_bytes(double index_count, double particles, double awake);

class Automaton : public grains::Model {
 public:
  /// Throws std::invalid_argument if the state (see grains::check_valid,
  /// grains::Occupancy) or the rules (see check_rules) are not valid, or the number of threads is
  /// not positive.
  explicit Automaton(grains::State state, const Rules& rules = {}, const Options& options = {});

  const grains::State& state() const { return grains(); }
  const Rules& rules() const;
};

}  // namespace clca::automaton
