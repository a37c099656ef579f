// The Baxter model in random boxes: what holds for every one of them.

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include "clca/baxter/baxter_model.hpp"
#include "property/random_states.hpp"

namespace clca::baxter_test {
namespace {

using baxter::BaxterModel;
using baxter::Rules;
using grains::State;

struct Start {
  State state;
  Rules rules;

  BaxterModel model(int threads = 1) const {
    return BaxterModel(state, rules, {.threads = threads, .min_parallel_particles = 1});
  }
};

/// Up to two walls, grains of one or two species, and often a source and an outlet.
Start any_start() {
  State state = testing::any_box(*rc::gen::arbitrary<bool>(), 0, 50);
  const lattice::Rectangle all = testing::whole(state.lattice);
  const Rules rules = {.exponent = *rc::gen::element(0, 1, 3, baxter::kMaxPower),
                       .gravity = *rc::gen::element(0.0, 0.15, 3.0, baxter::kMaxGravity),
                       .like_axes_factor = *rc::gen::element(0.0, 0.01, 1.0)};
  const auto species = *rc::gen::inRange<std::uint16_t>(1, 3);
  for (std::uint16_t i = 0; i < species; ++i) {
    for (const grains::Kind& kind : baxter::kinds_along_axes(i)) {
      state.kinds.push_back(kind);
    }
  }
  if (*rc::gen::arbitrary<bool>()) {
    state.outlets.push_back({.region = {all.left, 0, all.right / 3, 2}});
  }
  if (*rc::gen::arbitrary<bool>()) {
    state.sources.push_back({.sites = {{state.lattice.columns() / 2, state.lattice.rows() - 1}},
                             .weights = std::vector<std::uint32_t>(state.kinds.size(), 1),
                             .rate = std::uint64_t{1} << 31U,
                             .max_emitted = 20,
                             .open = true});
  }
  BaxterModel model(state, rules);
  model.fill(all, std::vector<std::size_t>(species, *rc::gen::inRange<std::size_t>(1, 300)));
  return {model.state(), rules};
}

RC_GTEST_PROP(BaxterProperty, GrainsStayWholeInTheirSpeciesAndMoveAtMostOneSiteAndNeverStraightUp,
              ()) {
  BaxterModel model = any_start().model();
  std::size_t count = grains::present_count(model.state());
  for (int step = 0; step < 60; ++step) {
    const State before = model.state();
    const grains::StepReport report = model.step();
    const State& after = model.state();
    count += report.emitted_count - report.removed_count;
    RC_ASSERT(grains::present_count(after) == count);
    grains::check_valid(after);
    // Built anew from the grains it throws on any overlap.
    RC_ASSERT(grains::Occupancy(after) == model.occupancy());
    for (std::size_t id = 0; id < before.particles.size(); ++id) {
      const grains::Particle& one = after.particles[id];
      const lattice::Axial step_taken = one.site() - before.particles[id].site();
      RC_ASSERT(lattice::length_in_steps(step_taken) <= 1);
      RC_ASSERT(step_taken != lattice::unit(lattice::Direction::up));
      RC_ASSERT(after.kinds[one.kind].species == before.kinds[before.particles[id].kind].species);
      if (one.present) {
        RC_ASSERT((one.previous == grains::kRest) == (step_taken == lattice::Axial{}));
      }
    }
  }
}

RC_GTEST_PROP(BaxterProperty, ARunGoesOnFromAnyOfItsStatesOnAnyNumberOfThreads, ()) {
  const Start start = any_start();
  BaxterModel model = start.model();
  for (int step = *rc::gen::inRange(0, 40); step > 0; --step) {
    model.step();
  }
  BaxterModel resumed = Start{model.state(), start.rules}.model(3);
  for (int step = 0; step < 20; ++step) {
    model.step();
    resumed.step();
    RC_ASSERT(resumed.state() == model.state());
    RC_ASSERT(grains::hash(resumed.state()) == grains::hash(model.state()));
  }
}

RC_GTEST_PROP(BaxterProperty, ASettledStateIsAFixedPoint, ()) {
  BaxterModel model = any_start().model();
  for (int step = 0; step < 300; ++step) {
    if (model.step().settled) {
      const std::vector<grains::Particle> settled = model.state().particles;
      RC_ASSERT(model.step().settled);
      RC_ASSERT(model.state().particles == settled);
      return;
    }
  }
  // Pairs that turn to each other's axis never settle.
  RC_TAG("not settled");
}

RC_GTEST_PROP(BaxterProperty, WithoutAnEnergyOfAxesNoGrainTurns, ()) {
  Start start = any_start();
  start.rules.like_axes_factor = 1;
  BaxterModel model = start.model();
  for (int step = 0; step < 40; ++step) {
    model.step();
    for (std::size_t id = 0; id < start.state.particles.size(); ++id) {
      RC_ASSERT(model.state().particles[id].kind == start.state.particles[id].kind);
    }
  }
}

}  // namespace
}  // namespace clca::baxter_test
