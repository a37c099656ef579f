#pragma once
// Discharge through outlets over time.

#include <cstdint>
#include <vector>

#include "clca/fields/fields.hpp"
#include "clca/grains/occupancy.hpp"
#include "clca/grains/state.hpp"

namespace clca::measure {

/// Particles and sites that all outlets together have removed.
struct Discharge {
  std::uint64_t particles = 0;
  std::uint64_t sites = 0;

  static constexpr auto fields() {
    using fields::field;
    return std::make_tuple(field("particles", &Discharge::particles),
                           field("sites", &Discharge::sites));
  }
};

Discharge discharge(const grains::State& state);

/// True when a particle hangs over every column that opens into an outlet: a state at rest that is
/// so has clogged (one that flows is so too). Throws std::invalid_argument for the occupancy of
/// another box.
bool blocked(const grains::State& state, const grains::Occupancy& occupancy);

/// Records the discharge of a stage, step by step.
class Outflow {
 public:
  /// Starts at `begin`, the totals before the stage.
  explicit Outflow(Discharge begin) : begin_(begin), last_(begin) {}

  /// Call after each step with the totals so far. Throws std::invalid_argument where they are less
  /// than before.
  void add(Discharge total);

  Discharge during_stage() const {
    return {last_.particles - begin_.particles, last_.sites - begin_.sites};
  }
  /// Sites per step between the moments at which 20 % and 70 % of what has left in the end had
  /// left: the steady part. 0 where less than two particles have left.
  double sites_per_step() const;
  /// Whether it can have been recorded in a run that has come to `now`.
  bool precedes(const grains::State& now) const;

  static constexpr auto fields();

 private:
  /// Sites that had left after so many steps.
  struct Event {
    std::uint64_t step = 0;
    std::uint64_t sites = 0;

    static constexpr auto fields() {
      using fields::field;
      return std::make_tuple(field("step", &Event::step), field("sites", &Event::sites));
    }
  };

  Discharge begin_;
  Discharge last_;
  std::uint64_t steps_ = 0;
  std::vector<Event> events_;  // the steps in which something left
};

constexpr auto Outflow::fields() {
  using fields::field;
  return std::make_tuple(field("begin", &Outflow::begin_), field("last", &Outflow::last_),
                         field("steps", &Outflow::steps_), field("events", &Outflow::events_));
}

}  // namespace clca::measure
