// Random boxes that nothing enters: the energy of the grains.

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>

#include "property/random_contact_runs.hpp"

namespace clca::contact_energy_test {
namespace {

using contact::ContactModel;
using testing::any_contact_run;
using testing::ContactRun;

constexpr int kSteps = 240;

double total_energy(const ContactModel& model, double gravity) {
  const contact::Energy energy = contact::energy(model.state(), gravity);
  return energy.kinetic + energy.potential;
}

// Of hexagons and discs in a box, with some friction, where the fall height is not below that of
// the box and steps are not longer than they are by default. Half a percent is for what sites cost:
// grains that hardly move stay where they are, and those without room are set back to two spacings.
// Without friction more is won in one box of some hundreds, where velocities along a row go on
// though the lattice has no room for them; likewise where a wall touches a grain from two sides.
RC_GTEST_PROP(ContactEnergyProperty, EnergyDoesNotGrow, ()) {
  ContactRun run = any_contact_run(false, kSteps);
  RC_PRE(run.state.grains.walls.empty());
  RC_PRE(std::all_of(run.state.grains.kinds.begin(), run.state.grains.kinds.end(),
                     [](const auto& kind) { return kind.shape.is_round(); }));
  run.parameters.restitution = std::min(run.parameters.restitution, 0.5);
  run.parameters.friction = std::clamp(run.parameters.friction, 0.1, 1.0);
  run.parameters.wall_friction = std::min(run.parameters.wall_friction, 1.0);
  run.parameters.resolution = testing::within(10, 41) / 100.0;
  run.parameters.fall_height =
      std::max(run.parameters.fall_height, 1.0 * run.state.grains.lattice.rows());
  ContactModel model = run.model();
  const double gravity = contact::gravity(run.parameters);
  const double before = total_energy(model, gravity);
  for (int step = 0; step < kSteps; ++step) {
    run.step(model, step);
    RC_ASSERT(total_energy(model, gravity) <= 1.005 * before);
  }
}

}  // namespace
}  // namespace clca::contact_energy_test
