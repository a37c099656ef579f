#include "run/contact_record.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace clca::run {

namespace {

/// Whether the stage may end after as many more steps as the window has, or fewer. Where that takes
/// a bed at rest it may only if `quiet`.
bool may_end_soon(const scene::Stage& stage, std::uint64_t steps, std::uint64_t window,
                  bool quiet) {
  if (const auto* until = std::get_if<scene::UntilSteps>(&stage.until)) {
    return steps + window > until->steps;
  }
  return quiet || steps + window > stage.max_steps ||
         !std::holds_alternative<scene::UntilSettled>(stage.until);
}

bool is_sound(const contact::ForceSums::Sum& sum, const grains::State& state) {
  const std::size_t grains = state.particles.size();
  const bool there =
      sum.upper < grains &&
      (grains::is_particle(sum.other) ? static_cast<std::size_t>(sum.other) < grains
                                      : sum.other <= contact::kRightSide ||
                                            (grains::is_wall(sum.other) &&
                                             grains::wall_number(sum.other) < state.walls.size()));
  const auto numbers = {sum.place_x,  sum.place_y,  sum.normal_x, sum.normal_y,
                        sum.branch_x, sum.branch_y, sum.force_x,  sum.force_y};
  return there && std::all_of(numbers.begin(), numbers.end(),
                              [](double number) { return std::isfinite(number); });
}

}  // namespace

void ForceWindow::add(const std::vector<contact::Force>& forces, std::uint64_t most) {
  const std::uint64_t block = (most + 1) / 2;
  if (block_.steps >= block) {
    before_ = std::exchange(block_, {});
    if (most == 1) {
      before_ = {};
    }
  }
  contact::add(block_, forces);
}

std::vector<contact::Force> ForceWindow::means() const {
  contact::ForceSums all = before_;
  contact::add(all, block_);
  return contact::means(all);
}

bool ForceWindow::is_of(const grains::State& state) const {
  const auto all_sound = [&](const contact::ForceSums& sums) {
    return (sums.steps > 0 || sums.sums.empty()) &&
           std::all_of(sums.sums.begin(), sums.sums.end(),
                       [&](const auto& sum) { return is_sound(sum, state); });
  };
  return all_sound(before_) && all_sound(block_);
}

ContactRecord::ContactRecord(const scene::Scene& scene)
    : sampling_(scene.output.contacts.value_or(scene::Contacts{})),
      most_((sampling_.window + sampling_.every - 1) / sampling_.every),
      picture_every_(pictures_show_forces(scene) ? scene.output.frames->every : 0),
      has_tables_(std::find(scene.measures.begin(), scene.measures.end(), scene::Measure::force) !=
                  scene.measures.end()) {}

void ContactRecord::begin_stage() {
  stage_.clear();
  picture_.clear();
  picture_due_ = false;
}

void ContactRecord::after_step(const scene::Stage& stage, const Model& model,
                               const Model::Report& report, std::uint64_t steps_in_stage) {
  if (std::exchange(picture_due_, false)) {
    picture_.clear();
  }
  const bool shows = picture_every_ > 0;
  picture_due_ = shows && steps_in_stage % picture_every_ == 0;
  const bool ends_soon =
      (has_tables_ || shows) && may_end_soon(stage, steps_in_stage, sampling_.window, report.quiet);
  if (!ends_soon && !stage_.is_empty()) {
    stage_.clear();
  }
  if (steps_in_stage % sampling_.every != 0) {
    return;
  }
  const std::uint64_t to_picture =
      shows ? (picture_every_ - steps_in_stage % picture_every_) % picture_every_ : 0;
  const bool pictured_soon = shows && to_picture < sampling_.window;
  if (!ends_soon && !pictured_soon) {
    return;
  }
  const std::vector<contact::Force> forces = *model.forces();
  if (ends_soon) {
    stage_.add(forces, most_);
  }
  if (pictured_soon) {
    picture_.add(forces, most_);
  }
}

std::vector<contact::Force> ContactRecord::at_end(const Model& model) const {
  return stage_.is_empty() ? *model.forces() : stage_.means();
}

std::vector<contact::Force> ContactRecord::of_picture(const Model& model) const {
  return picture_due_ && !picture_.is_empty() ? picture_.means() : at_end(model);
}

bool pictures_show_forces(const scene::Scene& scene) {
  return scene.model == scene::Model::contact && scene.output.frames &&
         (scene.output.frames->overlay == scene::Overlay::forces ||
          scene.output.frames->color_by == scene::ColorBy::force);
}

}  // namespace clca::run
