// The void model in random boxes: what holds for every one of them.

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include "clca/voids/void_model.hpp"
#include "property/random_states.hpp"

namespace clca::voids_test {
namespace {

using grains::State;
using voids::Rules;
using voids::VoidModel;

struct Start {
  State state;
  Rules rules;

  VoidModel model() const { return VoidModel(state, rules); }
};

/// `min_walls` to two walls, grains of one to three species, and often a source and an outlet.
Start any_start(int min_walls = 0) {
  State state = testing::any_box(*rc::gen::arbitrary<bool>(), min_walls, 50);
  const lattice::Rectangle all = testing::whole(state.lattice);
  Rules rules = {.straight_weight = *rc::gen::element(0.0, 1.0 / 3, 0.678, 1.0),
                 .sieve_factors = {}};
  const auto species = *rc::gen::inRange<std::uint16_t>(1, 4);
  for (std::uint16_t i = 0; i < species; ++i) {
    state.kinds.push_back({lattice::Shape::hexagon(0), i});
    rules.sieve_factors.push_back(*rc::gen::element(0.0, 0.1, 0.5, 1.0));
  }
  if (*rc::gen::arbitrary<bool>()) {
    state.outlets.push_back({.region = {all.left, 0, all.right / 3, 2}});
  }
  if (*rc::gen::arbitrary<bool>()) {
    state.sources.push_back({.sites = {{state.lattice.columns() / 2, state.lattice.rows() - 1}},
                             .weights = std::vector<std::uint32_t>(species, 1),
                             .rate = std::uint64_t{1} << 31U,
                             .max_emitted = 20,
                             .open = true});
  }
  const std::vector<std::size_t> counts(species, *rc::gen::inRange<std::size_t>(1, 300));
  VoidModel model(state, rules);
  model.fill(all, counts);
  return {model.state(), rules};
}

/// Sum of the heights of the grains in the box, in half lattice spacings.
long long potential(const State& state) {
  long long sum = 0;
  for (const grains::Particle& grain : state.particles) {
    sum += grain.present ? lattice::doubled_height(grain.site()) : 0;
  }
  return sum;
}

RC_GTEST_PROP(VoidsProperty, ARunGoesOnFromAnyOfItsStates, ()) {
  const Start start = any_start();
  VoidModel model = start.model();
  for (int step = *rc::gen::inRange(0, 40); step > 0; --step) {
    model.step();
  }
  VoidModel resumed(model.state(), start.rules);
  for (int step = 0; step < 20; ++step) {
    model.step();
    resumed.step();
    RC_ASSERT(resumed.state() == model.state());
  }
}

RC_GTEST_PROP(VoidsProperty, GrainsFallByWholeSitesUntilTheEndWhichIsAFixedPoint, ()) {
  VoidModel model = any_start().model();
  grains::StepReport report;
  std::size_t count = grains::present_count(model.state());
  do {
    const long long before = potential(model.state());
    report = model.step();
    count += report.emitted_count - report.removed_count;
    RC_ASSERT(grains::present_count(model.state()) == count);
    // Built anew from the grains it throws on any overlap.
    RC_ASSERT(grains::Occupancy(model.state()) == model.occupancy());
    if (report.emitted_count == 0 && report.removed_count == 0) {
      const long long lowered = before - potential(model.state());
      const auto moved = static_cast<long long>(report.moved_count);
      RC_ASSERT(lowered >= moved);
      RC_ASSERT(lowered <= 2 * moved);
    }
  } while (!report.settled);
  const std::vector<grains::Particle> settled = model.state().particles;
  RC_ASSERT(model.step().settled);
  RC_ASSERT(model.state().particles == settled);
}

RC_GTEST_PROP(VoidsProperty, AWallThatGoesIsSeen, ()) {
  const Start start = any_start(1);
  VoidModel model = start.model();
  for (int step = 0; step < 200; ++step) {
    model.step();
  }
  model.remove_wall(0);
  VoidModel reference(model.state(), start.rules, {.use_reference = true});
  for (int step = 0; step < 20; ++step) {
    model.step();
    reference.step();
    RC_ASSERT(model.state() == reference.state());
  }
}

}  // namespace
}  // namespace clca::voids_test
