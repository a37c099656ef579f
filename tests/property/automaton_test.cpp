// Random boxes, shapes, walls and rules: what holds for every one of them.

#include "clca/automaton/automaton.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cstdint>

#include "support/oracle.hpp"

namespace clca {
namespace {

using automaton::Automaton;
using automaton::State;
using lattice::Axial;
using lattice::Direction;
using lattice::Shape;

/// A connected set of sites without holes, grown at random.
Shape grown_shape() {
  const int size = *rc::gen::inRange(1, 9);
  std::vector<Axial> sites = {{0, 0}};
  while (static_cast<int>(sites.size()) < size) {
    const auto from = sites[*rc::gen::inRange<std::size_t>(0, sites.size())];
    const auto site = from + unit(lattice::kDirections[*rc::gen::inRange<std::size_t>(0, 6)]);
    if (std::find(sites.begin(), sites.end(), site) == sites.end()) {
      sites.push_back(site);
    }
  }
  try {
    return Shape(sites);
  } catch (const std::invalid_argument&) {
    return Shape::hexagon(1);  // it had grown around a hole
  }
}

Shape any_shape() {
  switch (*rc::gen::inRange(0, 4)) {
    case 0:
      return Shape::hexagon(*rc::gen::inRange(0, 4));
    case 1:
      return Shape::rod(*rc::gen::inRange(0, 2), *rc::gen::inRange(1, 5))
          .rotated(*rc::gen::inRange(0, 6));
    case 2:
      return Shape::polygon(std::vector<Axial>{{0, 0}, {3, 0}, {0, 3}})
          .rotated(*rc::gen::inRange(0, 6));
    default:
      return grown_shape();
  }
}

automaton::Rules any_rules(bool downward_only) {
  automaton::Rules rules;
  rules.inertia = *rc::gen::element(0.0, 0.5, 0.9, 1.0);
  rules.scatter = *rc::gen::element(0.0, 0.0, 0.3, 1.0);
  rules.gravity = lattice::kDirections[*rc::gen::inRange<std::size_t>(0, 6)];
  rules.ties = *rc::gen::element(automaton::Ties::particle, automaton::Ties::direction);
  std::sort(rules.update_priority.begin(), rules.update_priority.end());
  const int permutations = *rc::gen::inRange(0, 6);
  for (int i = 0; i < permutations; ++i) {
    std::next_permutation(rules.update_priority.begin(), rules.update_priority.end());
  }
  if (!downward_only && *rc::gen::inRange(0, 3) == 0) {
    rules.candidates = automaton::Candidates::all;
  }
  return rules;
}

/// A box with `least_walls` to two walls and some particles placed by the fill.
State any_state(bool downward_only, int least_walls = 0) {
  const automaton::Rules rules = any_rules(downward_only);
  // Where gravity has a sideways part, a periodic box has no floor to come to rest on.
  const bool upright = rules.gravity == Direction::down || rules.gravity == Direction::up;
  const bool periodic = *rc::gen::arbitrary<bool>() && (upright || !downward_only);
  const int columns = 2 * *rc::gen::inRange(8, 25);
  const int rows = *rc::gen::inRange(10, 70);
  State state{.lattice = lattice::Lattice(columns, rows, periodic),
              .rules = rules,
              .seed = *rc::gen::arbitrary<std::uint64_t>()};
  const double width = columns * lattice::kColumnPitch;
  const int walls = *rc::gen::inRange(least_walls, 3);
  for (int i = 0; i < walls; ++i) {
    const auto along = [&](double extent) { return extent * *rc::gen::inRange(0, 100) / 100; };
    const lattice::Segment segment{{along(width), along(rows)}, {along(width), along(rows)}, 1.5};
    state.walls.push_back({.sites = sites_along(state.lattice, segment), .present = true});
  }
  const int species = *rc::gen::inRange(1, 4);
  for (int i = 0; i < species; ++i) {
    state.kinds.push_back({any_shape(), static_cast<std::uint16_t>(i)});
  }
  const std::vector<std::size_t> counts(state.kinds.size(), *rc::gen::inRange<std::size_t>(1, 40));
  Automaton automaton(state);
  automaton.fill({0, 0, width, static_cast<double>(rows)}, counts);
  return automaton.state();
}

RC_GTEST_PROP(AutomatonProperty, EveryStepEqualsTheSequentialOracle, ()) {
  State expected = any_state(false);
  Automaton automaton(expected);
  for (int step = 0; step < 40; ++step) {
    const std::size_t moved = testing::oracle_step(expected);
    RC_ASSERT(automaton.step().moved == moved);
    RC_ASSERT(automaton.state() == expected);
  }
}

RC_GTEST_PROP(AutomatonProperty, ThreadsAndSleepingChangeNothing, ()) {
  const State state = any_state(false);
  Automaton plain(state);
  Automaton threaded(state, {.threads = 3, .parallel_from = 1});
  Automaton sleepless(state, {.sleeping = false});
  for (int step = 0; step < 60; ++step) {
    plain.step();
    threaded.step();
    sleepless.step();
  }
  RC_ASSERT(threaded.state() == plain.state());
  RC_ASSERT(sleepless.state() == plain.state());
  RC_ASSERT(automaton::hash(threaded.state()) == automaton::hash(plain.state()));
}

RC_GTEST_PROP(AutomatonProperty, NothingOverlapsAndNothingIsLost, ()) {
  Automaton automaton(any_state(false));
  const std::size_t count = automaton.state().particles.size();
  for (int step = 0; step < 60; ++step) {
    automaton.step();
    RC_ASSERT(automaton::present_count(automaton.state()) == count);
    // Built anew from the particles it throws on any overlap.
    RC_ASSERT(automaton::Occupancy(automaton.state()) == automaton.occupancy());
  }
}

RC_GTEST_PROP(AutomatonProperty, HeightsFallWhileAnythingMovesAndTheEndIsAFixedPoint, ()) {
  Automaton automaton(any_state(true));
  long long before = testing::potential(automaton.state());
  automaton::StepReport report;
  do {
    report = automaton.step();
    const long long after = testing::potential(automaton.state());
    RC_ASSERT((report.moved > 0 ? after < before : after == before));
    before = after;
  } while (!report.settled);
  const std::vector<automaton::Particle> settled = automaton.state().particles;
  for (int step = 0; step < 5; ++step) {
    RC_ASSERT(automaton.step().settled);
  }
  RC_ASSERT(automaton.state().particles == settled);
}

RC_GTEST_PROP(AutomatonProperty, RemovingAWallWakesWhoeverStoodOnIt, ()) {
  Automaton automaton(any_state(true, 1));
  while (!automaton.step().settled) {
  }
  automaton.remove_wall(0);
  State expected = automaton.state();
  for (int step = 0; step < 30; ++step) {
    automaton.step();
    testing::oracle_step(expected);
    RC_ASSERT(automaton.state() == expected);
  }
}

}  // namespace
}  // namespace clca
