// Random runs of the contact model: what holds for every one of them.

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <numeric>

#include "property/random_contact_runs.hpp"

namespace clca {
namespace {

using contact::ContactModel;
using contact::StepReport;
using testing::any_contact_run;
using testing::ContactRun;

constexpr int kSteps = 120;

std::uint64_t left_count(const grains::State& state) {
  return std::accumulate(
      state.outlets.begin(), state.outlets.end(), std::uint64_t{0},
      [](std::uint64_t sum, const grains::Outlet& outlet) { return sum + outlet.particles; });
}

RC_GTEST_PROP(ContactProperty, EveryStepEqualsTheReference, ()) {
  const ContactRun run = any_contact_run(true, kSteps);
  ContactModel fast = run.model();
  ContactModel reference = run.model(true);
  for (int step = 0; step < kSteps; ++step) {
    const StepReport expected = run.step(reference, step);
    const StepReport report = run.step(fast, step);
    RC_ASSERT(fast.state() == reference.state());
    RC_ASSERT(report.moved == expected.moved);
    RC_ASSERT(report.emitted == expected.emitted);
    RC_ASSERT(report.removed == expected.removed);
    RC_ASSERT(report.settled == expected.settled);
  }
  RC_ASSERT(contact::hash(fast.state()) == contact::hash(reference.state()));
}

RC_GTEST_PROP(ContactProperty, AFreshStartFromACopyChangesNothing, ()) {
  const ContactRun run = any_contact_run(true, kSteps);
  const int fresh_start = testing::within(0, kSteps);
  ContactModel whole = run.model();
  ContactModel resumed = run.model();
  for (int step = 0; step < kSteps; ++step) {
    if (step == fresh_start) {
      const contact::State saved = resumed.state();
      resumed = run.model_from(saved);
      RC_ASSERT(resumed.state() == saved);
    }
    RC_ASSERT(run.step(whole, step).settled == run.step(resumed, step).settled);
  }
  RC_ASSERT(resumed.state() == whole.state());
}

RC_GTEST_PROP(ContactProperty, NothingOverlapsAndTheStateStaysValid, ()) {
  const ContactRun run = any_contact_run(true, kSteps);
  ContactModel model = run.model();
  for (int step = 0; step < kSteps; ++step) {
    run.step(model, step);
    // Built anew from the grains it throws on any overlap.
    RC_ASSERT(grains::Occupancy(model.grains()) == model.occupancy());
    contact::check_valid(model.state());
  }
}

/// Whether two grains may touch each other from both sides of the seam. They have one contact all
/// the same, so that one of the sides does not hold.
bool touch_across_the_seam(const grains::State& state) {
  return state.lattice.periodic() &&
         std::any_of(state.kinds.begin(), state.kinds.end(), [&](const grains::Kind& kind) {
           const auto& sites = kind.shape.sites();  // sorted by columns
           return 2 * (sites.back().x - sites.front().x + 1) >= state.lattice.columns();
         });
}

double total_energy(const ContactModel& model, double gravity) {
  const contact::Energy energy = contact::energy(model.state(), gravity);
  return energy.kinetic + energy.potential;
}

// Of hexagons in a box, where the fall height is not below that of the box and steps are not longer
// than they are by default. Half a percent is for what sites cost: grains that hardly move stay
// where they are, and those without room are set back to two spacings.
RC_GTEST_PROP(ContactProperty, EnergyDoesNotGrow, ()) {
  ContactRun run = any_contact_run(false, kSteps);
  RC_PRE(run.state.grains.walls.empty() && !touch_across_the_seam(run.state.grains));
  RC_PRE(std::all_of(run.state.grains.kinds.begin(), run.state.grains.kinds.end(),
                     [](const auto& kind) { return kind.shape.hexagon_radius().has_value(); }));
  run.parameters.restitution = std::min(run.parameters.restitution, 0.5);
  run.parameters.friction = std::min(run.parameters.friction, 1.0);
  run.parameters.wall_friction = std::min(run.parameters.wall_friction, 1.0);
  run.parameters.resolution = testing::within(10, 41) / 100.0;
  run.parameters.fall_height =
      std::max(run.parameters.fall_height, 1.0 * run.state.grains.lattice.rows());
  ContactModel model = run.model();
  const double gravity = contact::gravity(run.parameters);
  const double before = total_energy(model, gravity);
  for (int step = 0; step < 2 * kSteps; ++step) {
    run.step(model, step);
    RC_ASSERT(total_energy(model, gravity) <= 1.005 * before);
  }
}

RC_GTEST_PROP(ContactProperty, WhatEntersIsThereOrHasLeft, ()) {
  const ContactRun run = any_contact_run(true, kSteps);
  ContactModel model = run.model();
  std::size_t count = grains::present_count(run.state.grains);
  for (int step = 0; step < kSteps; ++step) {
    const std::size_t particles = model.grains().particles.size();
    const std::uint64_t left = left_count(model.grains());
    const StepReport report = run.step(model, step);
    const grains::State& now = model.grains();
    count += now.particles.size() - particles;
    count -= left_count(now) - left;
    RC_ASSERT(report.removed <= left_count(now) - left);
    RC_ASSERT(grains::present_count(now) == count);
    RC_ASSERT(model.state().velocities.size() == now.particles.size());
  }
}

}  // namespace
}  // namespace clca
