#include "baxter/step.hpp"

#include <utility>

namespace clca::baxter {

Steps::Steps(grains::State initial, const Rules& rules)
    : state_(std::move(initial)), box_(state_), rule_(box_, rules) {}

bool Steps::advance(grains::StepReport& report) {
  std::vector<Choice> choices;
  for (std::uint32_t id = 0; id < state_.particles.size(); ++id) {
    if (state_.particles[id].present) {
      choices.push_back(rule_.choice(id));
    }
  }
  const std::vector<Choice> winners = rule_.winners(choices);

  bool changed = false;
  const auto turn = [&](grains::Particle& grain, std::uint16_t axis) {
    changed = changed || axis != axis_of(grain);
    grain.kind = static_cast<std::uint16_t>(grain.kind - axis_of(grain) + axis);
  };
  for (const Choice& one : choices) {
    grains::Particle& grain = state_.particles[one.id];
    changed = changed || grain.previous != grains::kRest;
    grain.previous = grains::kRest;
    if (one.velocity == grains::kRest) {
      turn(grain, one.axis);
    }
  }
  // All at once: a target was free when the step began, so no grain that moves leaves it.
  moved_.clear();
  for (const Choice& one : winners) {
    grains::Particle& grain = state_.particles[one.id];
    box_.occupancy.release(state_.lattice.index(grain.site()));
    grain = grains::moved(grain, static_cast<lattice::Direction>(one.velocity));
    grain.previous = one.velocity;
    turn(grain, one.axis);
    box_.occupancy.take(state_.lattice.index(grain.site()), grains::as_owner(one.id));
    moved_.push_back(one.id);
  }
  report.moved = moved_.size();
  ++state_.step;
  return moved_.empty() && !changed;
}

}  // namespace clca::baxter
