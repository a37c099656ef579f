// Random boxes, shapes, walls and rules: what holds for every one of them.

#include "clca/automaton/automaton.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include "property/random_states.hpp"

namespace clca::automaton_test {
namespace {

using automaton::Automaton;
using grains::State;
using testing::any_state;

/// Sum of the heights of all particles against gravity, in half lattice spacings.
long long potential(const State& state, const automaton::Rules& rules) {
  const Eigen::Vector2d up = lattice::position(unit(opposite(rules.gravity)));
  long long sum = 0;
  for (const grains::Particle& particle : state.particles) {
    sum += std::llround(2 * lattice::position(particle.site()).dot(up));
  }
  return sum;
}

RC_GTEST_PROP(AutomatonProperty, EveryStepEqualsTheReferenceStep, ()) {
  const testing::RuledState start = any_state(false);
  Automaton reference = start.automaton({.use_reference = true});
  Automaton automaton = start.automaton();
  for (int step = 0; step < 40; ++step) {
    const std::size_t moved = reference.step().moved_count;
    RC_ASSERT(automaton.step().moved_count == moved);
    RC_ASSERT(automaton.state() == reference.state());
  }
}

RC_GTEST_PROP(AutomatonProperty, ThreadsAndSleepingChangeNothing, ()) {
  const testing::RuledState start = any_state(false);
  Automaton plain = start.automaton();
  Automaton threaded = start.automaton({.threads = 3, .min_parallel_particles = 1});
  Automaton sleepless = start.automaton({.allow_sleeping = false});
  for (int step = 0; step < 60; ++step) {
    plain.step();
    threaded.step();
    sleepless.step();
  }
  RC_ASSERT(threaded.state() == plain.state());
  RC_ASSERT(sleepless.state() == plain.state());
  RC_ASSERT(grains::hash(threaded.state()) == grains::hash(plain.state()));
}

// Wide enough for particles that have a strip for themselves, and for those near a border.
RC_GTEST_PROP(AutomatonProperty, StripsOfColumnsChangeNothing, ()) {
  const testing::RuledState start = any_state(false, 0, 600);
  const int threads = *rc::gen::inRange(2, 5);
  Automaton plain = start.automaton();
  Automaton threaded = start.automaton(
      {.threads = threads, .min_parallel_particles = *rc::gen::inRange<std::size_t>(0, 40)});
  for (int step = 0; step < 60; ++step) {
    plain.step();
    threaded.step();
    RC_ASSERT(threaded.state() == plain.state());
  }
  RC_ASSERT(threaded.occupancy() == plain.occupancy());
}

RC_GTEST_PROP(AutomatonProperty, NothingOverlapsAndNothingIsLost, ()) {
  Automaton automaton = any_state(false).automaton();
  const std::size_t count = automaton.state().particles.size();
  for (int step = 0; step < 60; ++step) {
    automaton.step();
    RC_ASSERT(grains::present_count(automaton.state()) == count);
    // Built anew from the particles it throws on any overlap.
    RC_ASSERT(grains::Occupancy(automaton.state()) == automaton.occupancy());
  }
}

RC_GTEST_PROP(AutomatonProperty, HeightsFallWhileAnythingMovesAndTheEndIsAFixedPoint, ()) {
  Automaton automaton = any_state(true).automaton();
  long long before = potential(automaton.state(), automaton.rules());
  grains::StepReport report;
  do {
    report = automaton.step();
    const long long after = potential(automaton.state(), automaton.rules());
    RC_ASSERT((report.moved_count > 0 ? after < before : after == before));
    before = after;
  } while (!report.settled);
  const std::vector<grains::Particle> settled = automaton.state().particles;
  for (int step = 0; step < 5; ++step) {
    RC_ASSERT(automaton.step().settled);
  }
  RC_ASSERT(automaton.state().particles == settled);
}

RC_GTEST_PROP(AutomatonProperty, RemovingAWallWakesWhoeverStoodOnIt, ()) {
  Automaton automaton = any_state(true, 1).automaton();
  while (!automaton.step().settled) {
  }
  automaton.remove_wall(0);
  Automaton reference(automaton.state(), automaton.rules(), {.use_reference = true});
  for (int step = 0; step < 30; ++step) {
    automaton.step();
    reference.step();
    RC_ASSERT(automaton.state() == reference.state());
  }
}

}  // namespace
}  // namespace clca::automaton_test
