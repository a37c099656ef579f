#include "run/records.hpp"

#include <algorithm>

namespace clca::run {

Records::Records(const scene::Scene& scene)
    : scene_(scene), cycles_(scene.output.fields.value_or(scene::Fields{}).cell) {
  if (scene.output.fields) {
    fields_.emplace(*scene.output.fields);
  }
  if (has_overlaps(scene)) {
    forces_.emplace(scene.output.contacts);
  }
}

void Records::begin_stage(const scene::Stage& stage, const automaton::Automaton& automaton) {
  cycles_.begin_stage(scene_, stage, automaton.state());
  if (fields_) {
    fields_->begin_stage(stage.name, automaton.state());
  }
  if (forces_) {
    forces_->begin_stage();
  }
}

void Records::after_step(const automaton::Automaton& automaton, std::uint64_t steps_in_stage) {
  cycles_.after_step(automaton.state());
  if (fields_) {
    fields_->after_step(automaton.state());
  }
  if (forces_) {
    forces_->after_step(automaton, steps_in_stage);
  }
}

void Records::end_stage(const automaton::Automaton& automaton) {
  if (fields_) {
    fields_->end_stage(automaton.state());
  }
}

bool has_overlaps(const scene::Scene& scene) {
  return std::any_of(scene.walls.begin(), scene.walls.end(), [](const scene::Wall& wall) {
    return wall.motion && wall.passive == automaton::Passive::overlap;
  });
}

}  // namespace clca::run
