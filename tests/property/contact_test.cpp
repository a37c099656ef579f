// Random runs of the contact model: what holds for every one of them.

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <numeric>

#include "property/random_contact_runs.hpp"

namespace clca::contact_test {
namespace {

using contact::ContactModel;
using grains::StepReport;
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
  ContactModel reference = run.model({.use_reference = true});
  for (int step = 0; step < kSteps; ++step) {
    const StepReport expected = run.step(reference, step);
    const StepReport report = run.step(fast, step);
    RC_ASSERT(fast.state() == reference.state());
    RC_ASSERT(report.moved_count == expected.moved_count);
    RC_ASSERT(report.emitted_count == expected.emitted_count);
    RC_ASSERT(report.removed_count == expected.removed_count);
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
    RC_ASSERT(report.removed_count <= left_count(now) - left);
    RC_ASSERT(grains::present_count(now) == count);
    RC_ASSERT(model.state().velocities.size() == now.particles.size());
  }
}

}  // namespace
}  // namespace clca::contact_test
