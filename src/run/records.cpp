#include "run/records.hpp"

#include <algorithm>

namespace clca::run {

namespace {

constexpr const char* kCycles = "records/cycles";
constexpr const char* kFields = "records/fields";
constexpr const char* kLines = "records/lines";
constexpr const char* kMixing = "records/mixing";
constexpr const char* kForces = "records/forces";
constexpr const char* kContacts = "records/contacts";
constexpr const char* kEnergy = "records/energy";

template <class Record>
void load(const char* path, const reflection::Columns& columns, double max_bytes, Record& record,
          const grains::State& now) {
  reflection::decode(path, columns, max_bytes, record);
  if (!record.precedes(now)) {
    throw reflection::Mismatch(std::string(path) + " is not of this run");
  }
}

}  // namespace

Records::Records(const scene::Scene& scene)
    : scene_(scene), cycles_(scene.output.fields.value_or(scene::Fields{}).cell, scene) {
  if (scene.output.fields) {
    fields_.emplace(*scene.output.fields, scene::conversion(scene));
  }
  if (!scene.lines.empty() && scene.output.series) {
    lines_.emplace(scene);
  }
  const auto& wanted = scene.measures;
  if (std::find(wanted.begin(), wanted.end(), scene::Measure::mixing) != wanted.end()) {
    mixing_.emplace();
  }
  if (has_overlaps(scene)) {
    forces_.emplace(scene.output.contacts);
  }
  if (scene.model == scene::Model::contact) {
    contacts_.emplace(scene);
    energy_.emplace();
  }
}

void Records::begin_stage(const scene::Stage& stage, const Model& model) {
  cycles_.begin_stage(scene_, stage, model.state(), model.vessel());
  if (fields_) {
    fields_->begin_stage(stage.name, model.state());
  }
  if (lines_) {
    lines_->begin_stage(model.state());
  }
  if (mixing_) {
    mixing_ = measure::Mixing(model.state());
  }
  if (forces_) {
    forces_->begin_stage();
  }
  if (contacts_) {
    contacts_->begin_stage();
    energy_->begin_stage(stage, model);
  }
}

void Records::after_step(const scene::Stage& stage, const Model& model,
                         std::uint64_t steps_in_stage) {
  cycles_.after_step(model.state(), model.vessel());
  if (fields_) {
    fields_->after_step(model.state());
  }
  if (lines_) {
    lines_->after_step(model);
  }
  if (mixing_) {
    mixing_->add(model.state());
  }
  if (forces_) {
    forces_->after_step(model, steps_in_stage);
  }
  if (contacts_) {
    contacts_->after_step(stage, model, steps_in_stage);
    energy_->after_step(model, model.exchange());
  }
}

void Records::save(reflection::Columns& columns) const {
  reflection::encode(kCycles, cycles_, columns);
  if (fields_) {
    reflection::encode(kFields, *fields_, columns);
  }
  if (lines_) {
    reflection::encode(kLines, *lines_, columns);
  }
  if (mixing_) {
    reflection::encode(kMixing, *mixing_, columns);
  }
  if (forces_) {
    reflection::encode(kForces, *forces_, columns);
  }
  if (contacts_) {
    reflection::encode(kContacts, *contacts_, columns);
    reflection::encode(kEnergy, *energy_, columns);
  }
}

void Records::resume_stage(const scene::Stage& stage, const Model& model,
                           const reflection::Columns& columns, double max_bytes) {
  const grains::State& now = model.state();
  cycles_.resume_stage(scene_, stage, now);
  load(kCycles, columns, max_bytes, cycles_, now);
  if (fields_) {
    fields_->begin_stage(stage.name, now);
    load(kFields, columns, max_bytes, *fields_, now);
  }
  if (lines_) {
    lines_->begin_stage(now);
    load(kLines, columns, max_bytes, *lines_, now);
  }
  if (mixing_) {
    load(kMixing, columns, max_bytes, *mixing_, now);
  }
  if (forces_) {
    load(kForces, columns, max_bytes, *forces_, now);
  }
  if (contacts_) {
    load(kContacts, columns, max_bytes, *contacts_, now);
    reflection::decode(kEnergy, columns, max_bytes, *energy_);
  }
}

void Records::end_stage(const Model& model) {
  if (fields_) {
    fields_->end_stage(model.state());
  }
  if (lines_) {
    lines_->end_stage(model);
  }
}

bool has_overlaps(const scene::Scene& scene) {
  return std::any_of(scene.walls.begin(), scene.walls.end(), [](const scene::Wall& wall) {
    return wall.motion && wall.passive == grains::Passive::overlap;
  });
}

}  // namespace clca::run
