#include "run/outputs.hpp"

#include <algorithm>

#include "clca/measure/profile.hpp"
#include "clca/scene/resolve.hpp"
#include "clca/store/file.hpp"

namespace clca::run {

Outputs::Outputs(const scene::Scene& scene, const automaton::State& state, bool last_picture_only)
    : scene_(scene), last_picture_only_(last_picture_only) {
  if (scene.output.frames) {
    pictures_.emplace(scene, state);
  }
  if (scene.output.series) {
    series_.emplace(scene);
  }
}

void Outputs::open(const store::RunFolder& folder) {
  folder_ = &folder;
  if (pictures_) {
    folder.make_frames();
  }
  store::write_whole(folder.scene(), scene::to_yaml(scene_));
}

void Outputs::begin_stage(const scene::Stage& stage, const automaton::Automaton& automaton,
                          const Records& records) {
  if (pictures_) {
    pictures_->begin_stage(stage.name, automaton.state());
  }
  if (pictures_ && !last_picture_only_) {
    pictures_->draw(automaton, records, *folder_);
  }
  if (series_) {
    series_->add(stage.name, automaton, 0, true);
  }
}

void Outputs::after_step(const scene::Stage& stage, const automaton::Automaton& automaton,
                         const Records& records, std::uint64_t steps_in_stage, std::size_t moving) {
  if (pictures_ && !last_picture_only_ && steps_in_stage % scene_.output.frames->every == 0) {
    pictures_->draw(automaton, records, *folder_);
  }
  if (series_) {
    series_->add(stage.name, automaton, moving, false);
  }
}

void Outputs::end_stage(const scene::Stage& stage, const automaton::Automaton& automaton,
                        const Records& records, std::size_t moving, const StageHistory& history) {
  if (pictures_ && (!last_picture_only_ || &stage == &scene_.stages.back())) {
    pictures_->draw(automaton, records, *folder_);
  }
  if (series_) {
    series_->add(stage.name, automaton, moving, true);
    store::write_whole(folder_->table("series"), series_->to_csv());
  }
  write_tables(stage, automaton, records, history);
}

void Outputs::write_tables(const scene::Stage& stage, const automaton::Automaton& automaton,
                           const Records& records, const StageHistory& history) {
  const automaton::State& state = automaton.state();
  const auto write = [&](const char* kind, const std::string& csv) {
    store::write_whole(folder_->table(kind, stage.name), csv);
  };
  if (wants(scene::Measure::profile)) {
    write("profile", profile_table(history.profile_at_start, measure::surface_profile(state)));
  }
  if (!records.cycles().is_empty()) {
    store::write_whole(folder_->table("cycles"), records.cycles().to_csv());
  }
  if (wants(scene::Measure::convection) && records.cycles().convection() != nullptr) {
    write("convection", records.cycles().convection_csv());
  }
  if (records.fields()) {
    store::write_whole(folder_->table("fields"), records.fields()->to_csv());
    if (records.fields()->fluctuations().samples() > 0) {
      write("fluctuation", records.fields()->fluctuation_csv());
    }
  }
  if (wants(scene::Measure::force) && records.forces()) {
    const auto contacts = measure::contacts(state, automaton.occupancy());
    const auto summary = measure::force_summary(state, automaton.occupancy(), contacts);
    write("contacts", records.forces()->contacts_csv(scene_, contacts));
    write("forces", distribution_csv(records.forces()->distribution(contacts)));
    write("loads", loads_csv(scene_, state, contacts));
    write("walls", walls_csv(scene_, state, summary, history.profile_at_start));
  }
}

bool Outputs::wants(scene::Measure measure) const {
  const auto& wanted = scene_.measures;
  return std::find(wanted.begin(), wanted.end(), measure) != wanted.end();
}

void Outputs::finish() {
  if (pictures_) {
    pictures_->finish();
  }
}

}  // namespace clca::run
