// Random boxes, shapes, walls and rules: what holds for every one of them.

#include "clca/automaton/automaton.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include "property/random_states.hpp"
#include "support/oracle.hpp"

namespace clca {
namespace {

using automaton::Automaton;
using grains::State;
using testing::any_state;

RC_GTEST_PROP(AutomatonProperty, EveryStepEqualsTheSequentialOracle, ()) {
  auto [expected, rules] = any_state(false);
  Automaton automaton(expected, rules);
  for (int step = 0; step < 40; ++step) {
    const std::size_t moved = testing::oracle_step(expected, rules);
    RC_ASSERT(automaton.step().moved == moved);
    RC_ASSERT(automaton.state() == expected);
  }
}

RC_GTEST_PROP(AutomatonProperty, ThreadsAndSleepingChangeNothing, ()) {
  const testing::RuledState start = any_state(false);
  Automaton plain = start.automaton();
  Automaton threaded = start.automaton({.threads = 3, .parallel_from = 1});
  Automaton sleepless = start.automaton({.sleeping = false});
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
  Automaton threaded =
      start.automaton({.threads = threads, .parallel_from = *rc::gen::inRange<std::size_t>(0, 40)});
  for (int step = 0; step < 60; ++step) {
    const automaton::StepReport report = plain.step();
    RC_ASSERT(threaded.step().looked_at == report.looked_at);
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
  long long before = testing::potential(automaton.state(), automaton.rules());
  automaton::StepReport report;
  do {
    report = automaton.step();
    const long long after = testing::potential(automaton.state(), automaton.rules());
    RC_ASSERT((report.moved > 0 ? after < before : after == before));
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
  State expected = automaton.state();
  for (int step = 0; step < 30; ++step) {
    automaton.step();
    testing::oracle_step(expected, automaton.rules());
    RC_ASSERT(automaton.state() == expected);
  }
}

}  // namespace
}  // namespace clca
