// Random boxes in which walls move: what holds for every one of them.

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <string>

#include "property/random_motions.hpp"
#include "support/difference.hpp"
#include "support/overlaps.hpp"

namespace clca::moving_walls_test {
namespace {

using automaton::Automaton;
using grains::State;
using grains::StepReport;
using testing::any_moving_state;
using testing::MovingWalls;

constexpr int kSteps = 60;

bool lies_inside(const State& state, const grains::Particle& particle,
                 const lattice::Rectangle& region) {
  const testing::Sites sites = testing::body(state, particle);
  return std::all_of(sites.begin(), sites.end(),
                     [&](lattice::Site site) { return region.contains(lattice::position(site)); });
}

/// Adds a source and an outlet in which nothing lies yet.
void add_entry_and_exit(State& state) {
  const auto columns = static_cast<double>(state.lattice.columns());
  const double left = *rc::gen::inRange(0, 10);
  const double bottom = *rc::gen::inRange(0, 20);
  const lattice::Rectangle region{left, bottom, left + columns / 2, bottom + 8};
  const bool clear =
      std::none_of(state.particles.begin(), state.particles.end(),
                   [&](const auto& particle) { return lies_inside(state, particle, region); });
  if (clear) {
    state.outlets = {{.region = region}};
  }
  grains::Source source{.weights = std::vector<std::uint32_t>(state.kinds.size(), 1)};
  for (int i = 0; i < 5; ++i) {
    source.sites.push_back({*rc::gen::inRange(0, state.lattice.columns()),
                            *rc::gen::inRange(0, state.lattice.rows())});
  }
  source.rate = std::uint64_t{1} << 31U;
  source.max_emitted = 40;
  source.open = true;
  state.sources = {source};
}

RC_GTEST_PROP(MovingWallsProperty, EveryStepEqualsTheReferenceStep, ()) {
  auto [state, rules] = any_moving_state(MovingWalls::any);
  add_entry_and_exit(state);
  Automaton reference(state, rules, {.use_reference = true});
  Automaton automaton(state, rules);
  bool chained = false;
  for (int step = 0; step < kSteps; ++step) {
    const StepReport expected_report = reference.step();
    const StepReport report = automaton.step();
    const State& expected = reference.state();
    RC_ASSERT(testing::difference(automaton.state(), expected) == "");
    RC_ASSERT(report.moved_count == expected_report.moved_count);
    RC_ASSERT(report.removed_count == expected_report.removed_count);
    RC_ASSERT(report.settled == expected_report.settled);
    chained =
        chained || std::any_of(expected.pushes.begin(), expected.pushes.end(),
                               [](const auto& push) { return grains::is_particle(push.pusher); });
  }
  RC_CLASSIFY(chained, "particles pushed particles");
}

RC_GTEST_PROP(MovingWallsProperty, OverlapsArePushesAndStayShallowAndNothingIsLost, ()) {
  Automaton automaton = any_moving_state(MovingWalls::any).automaton();
  const std::size_t count = automaton.state().particles.size();
  for (int step = 0; step < kSteps; ++step) {
    automaton.step();
    RC_ASSERT(testing::complaint(automaton.state()) == "");
    RC_ASSERT(grains::present_count(automaton.state()) == count);
    RC_ASSERT(grains::Occupancy(automaton.state()) == automaton.occupancy());
  }
}

RC_GTEST_PROP(MovingWallsProperty, RigidWallsMakeNoOverlaps, ()) {
  Automaton automaton = any_moving_state(MovingWalls::rigid).automaton();
  for (int step = 0; step < kSteps; ++step) {
    automaton.step();
    RC_ASSERT(automaton.state().pushes.empty());
    RC_ASSERT(testing::overlapping_pairs(automaton.state()).empty());
  }
}

RC_GTEST_PROP(MovingWallsProperty, ThreadsSleepingAndAFreshStartChangeNothing, ()) {
  const testing::RuledState start = any_moving_state(MovingWalls::any);
  Automaton plain = start.automaton();
  Automaton threaded = start.automaton({.threads = 3, .min_parallel_particles = 1});
  Automaton sleepless = start.automaton({.allow_sleeping = false});
  Automaton resumed = start.automaton();
  const int fresh_start = *rc::gen::inRange(0, kSteps);
  for (int step = 0; step < kSteps; ++step) {
    if (step == fresh_start) {
      resumed = Automaton(resumed.state(), start.rules);
    }
    const bool settled = plain.step().settled;
    RC_ASSERT(threaded.step().settled == settled);
    RC_ASSERT(sleepless.step().settled == settled);
    RC_ASSERT(resumed.step().settled == settled);
    RC_ASSERT(threaded.state() == plain.state());
    RC_ASSERT(sleepless.state() == plain.state());
    RC_ASSERT(resumed.state() == plain.state());
  }
  RC_ASSERT(grains::hash(threaded.state()) == grains::hash(plain.state()));
}

RC_GTEST_PROP(MovingWallsProperty, WhatEntersAndLeavesIsCountedAndOutletsAreEmpty, ()) {
  auto [state, rules] = any_moving_state(MovingWalls::any);
  add_entry_and_exit(state);
  Automaton automaton(state, rules);
  Automaton sleepless(state, rules,
                      {.threads = 3, .min_parallel_particles = 1, .allow_sleeping = false});
  std::size_t count = grains::present_count(state);
  for (int step = 0; step < kSteps; ++step) {
    const StepReport report = automaton.step();
    sleepless.step();
    count += report.emitted_count;
    count -= report.removed_count;
    const State& now = automaton.state();
    RC_ASSERT(testing::difference(sleepless.state(), now) == "");
    RC_ASSERT(grains::present_count(now) == count);
    RC_ASSERT(testing::complaint(now) == "");
    RC_ASSERT(grains::Occupancy(now) == automaton.occupancy());
    for (const grains::Outlet& outlet : now.outlets) {
      RC_ASSERT(std::none_of(now.particles.begin(), now.particles.end(),
                             [&](const grains::Particle& particle) {
                               return particle.present && lies_inside(now, particle, outlet.region);
                             }));
    }
  }
}

RC_GTEST_PROP(MovingWallsProperty, WhatIsSettledStaysAsItIs, ()) {
  Automaton automaton = any_moving_state(MovingWalls::any).automaton();
  int steps = 0;
  while (!automaton.step().settled && ++steps < 400) {
  }
  if (steps == 400) {
    return;
  }
  const State settled = automaton.state();
  for (int step = 0; step < 30; ++step) {
    automaton.step();
    RC_ASSERT(automaton.state().particles == settled.particles);
    RC_ASSERT(automaton.state().pushes == settled.pushes);
    for (std::size_t wall = 0; wall < settled.walls.size(); ++wall) {
      RC_ASSERT(automaton.state().walls[wall].shift() == settled.walls[wall].shift());
    }
  }
}

}  // namespace
}  // namespace clca::moving_walls_test
