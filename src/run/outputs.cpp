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
    series_.emplace(*scene.output.series);
  }
}

void Outputs::open(const store::RunFolder& folder) {
  folder_ = &folder;
  store::write_whole(folder.scene(), scene::to_yaml(scene_));
}

void Outputs::begin_stage(const scene::Stage& stage, const automaton::Automaton& automaton) {
  if (pictures_) {
    pictures_->begin_stage(stage.name, automaton.state());
  }
  if (pictures_ && !last_picture_only_) {
    pictures_->draw(automaton, *folder_);
  }
  if (series_) {
    series_->add(stage.name, automaton.state(), 0, true);
  }
}

void Outputs::after_step(const scene::Stage& stage, const automaton::Automaton& automaton,
                         std::uint64_t steps_in_stage, std::size_t moving) {
  if (pictures_ && !last_picture_only_ && steps_in_stage % scene_.output.frames->every == 0) {
    pictures_->draw(automaton, *folder_);
  }
  if (series_) {
    series_->add(stage.name, automaton.state(), moving, false);
  }
}

void Outputs::end_stage(const scene::Stage& stage, const automaton::Automaton& automaton,
                        std::size_t moving, const StageHistory& history) {
  if (pictures_ && (!last_picture_only_ || &stage == &scene_.stages.back())) {
    pictures_->draw(automaton, *folder_);
  }
  if (series_) {
    series_->add(stage.name, automaton.state(), moving, true);
    store::write_whole(folder_->series(), series_->to_csv());
  }
  const auto& wanted = scene_.measures;
  if (std::find(wanted.begin(), wanted.end(), scene::Measure::profile) != wanted.end()) {
    store::write_whole(
        folder_->profile(stage.name),
        profile_table(history.profile_at_start, measure::surface_profile(automaton.state())));
  }
}

void Outputs::finish() {
  if (pictures_) {
    pictures_->finish();
  }
}

}  // namespace clca::run
