#include "record/internal/contact_record.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace clca::record {

namespace {

/// Whether the stage may end within the next window of steps; by rest only if `quiet`.
bool may_end_soon(const scene::Stage& stage, std::uint64_t steps, std::uint64_t window,
                  bool quiet) {
  if (const auto end = scene::fixed_steps(stage.until)) {
    return steps + window > *end;
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
                                            (grains::is_obstacle(sum.other) &&
                                             grains::wall_number(sum.other) < state.walls.size()));
  return there && sum.point.allFinite() && sum.normal.allFinite() && sum.branch.allFinite() &&
         sum.force.allFinite() && sum.touching_steps >= 0 && std::isfinite(sum.touching_steps);
}

}  // namespace

void ForceWindow::add(const std::vector<contact::Force>& forces, double mean_mass,
                      std::uint64_t most) {
  const std::uint64_t block = before_.steps == 0 ? most - most / 2 : most / 2;
  if (block_.steps >= block) {
    before_ = std::exchange(block_, {});
    if (most == 1) {
      before_ = {};
    }
  }
  contact::add(block_, forces, mean_mass);
}

std::vector<contact::Force> ForceWindow::means(double mean_mass) const {
  contact::ForceSums all = before_;
  contact::add(all, block_);
  contact::set_mean_mass(all, mean_mass);
  return contact::mean_forces(all);
}

bool ForceWindow::belongs_to(const grains::State& state) const {
  const auto all_sound = [&](const contact::ForceSums& sums) {
    const bool has_mass = sums.mean_mass > 0 && std::isfinite(sums.mean_mass);
    return (sums.steps > 0 ? has_mass : sums.sums.empty()) &&
           std::ranges::all_of(sums.sums, [&](const auto& sum) { return is_sound(sum, state); });
  };
  return all_sound(before_) && all_sound(block_);
}

void ContactRecord::Recurring::begin_step(std::uint64_t steps_in_stage) {
  if (due) {
    window = {};
  }
  due = every > 0 && steps_in_stage % every == 0;
}

bool ContactRecord::Recurring::is_due_within(std::uint64_t steps,
                                             std::uint64_t steps_in_stage) const {
  return every > 0 && (every - steps_in_stage % every) % every < steps;
}

ContactRecord::ContactRecord(const scene::Scene& scene)
    : sampling_(scene.output.contacts.value_or(scene::ContactSampling{})),
      most_((sampling_.window_steps + sampling_.every - 1) / sampling_.every),
      has_tables_(requests_measure(scene, scene::Measure::force) ||
                  requests_measure(scene, scene::Measure::weight_paths)),
      pictures_{.every = scene::pictures_show_forces(scene) ? scene.output.frames->every : 0},
      frames_{.every = scene.output.trajectory && scene.output.trajectory->has_contacts
                           ? scene.output.trajectory->every
                           : 0} {}

double ContactRecord::bytes(const scene::Scene& scene, double particles) {
  const ContactRecord record(scene);
  const int recurring = (record.pictures_.every > 0 ? 1 : 0) + (record.frames_.every > 0 ? 1 : 0);
  const int windows = recurring + (record.has_tables_ || recurring > 0 ? 1 : 0);
  constexpr double kBlocks = 3;  // of a window, with their sum
  return kBlocks * windows * contact::ForceSums::bytes_for(contact::kContactsPerGrain * particles);
}

void ContactRecord::prepare(const StageView& /*now*/) {
  stage_ = last_step_ = {};
  for (Recurring* recurring : {&pictures_, &frames_}) {
    recurring->window = {};
    recurring->due = false;
  }
}

void ContactRecord::after_step(const StageView& now) {
  const std::uint64_t steps_in_stage = now.history.steps;
  pictures_.begin_step(steps_in_stage);
  frames_.begin_step(steps_in_stage);
  const bool is_shown = pictures_.every > 0 || frames_.every > 0;
  const contact::ContactModel& model = *now.model.contact();
  const contact::State& state = model.state_with_old_contacts();
  // Nothing moved in the last two steps: impulses are those of rest, not of impacts.
  const bool quiet = state.quiet_steps > 1 ||
                     (state.unmoved_steps > 1 && state.unmoved_steps + sampling_.window_steps >=
                                                     model.unmoved_steps_at_rest());
  const bool ends_soon = (has_tables_ || is_shown) &&
                         may_end_soon(now.stage, steps_in_stage, sampling_.window_steps, quiet);
  if (!ends_soon) {
    stage_ = {};
  }
  last_step_ = {};
  if (steps_in_stage % sampling_.every != 0) {
    if (ends_soon && stage_.is_empty()) {
      last_step_.add(now.model.forces(), contact::mean_grain_mass(now.model.state()), 1);
    }
    return;
  }
  std::vector<ForceWindow*> takers;
  if (ends_soon) {
    takers.push_back(&stage_);
  }
  for (Recurring* recurring : {&pictures_, &frames_}) {
    if (recurring->is_due_within(sampling_.window_steps, steps_in_stage)) {
      takers.push_back(&recurring->window);
    }
  }
  if (takers.empty()) {
    return;
  }
  const std::vector<contact::Force> forces = now.model.forces();
  const double mean_mass = contact::mean_grain_mass(now.model.state());
  for (ForceWindow* window : takers) {
    window->add(forces, mean_mass, most_);
  }
}

std::vector<contact::Force> ContactRecord::stage_mean_forces(const model::SceneModel& model) const {
  const double mean_mass = contact::mean_grain_mass(model.state());
  return !stage_.is_empty()       ? stage_.means(mean_mass)
         : !last_step_.is_empty() ? last_step_.means(mean_mass)
                                  : model.forces();
}

std::vector<contact::Force> ContactRecord::shown_forces(const model::SceneModel& model) const {
  const Recurring& recurring = pictures_.due ? pictures_ : frames_;
  const std::vector<contact::Force> now = model.forces();
  std::vector<contact::Force> forces = stage_mean_forces(model);
  if (recurring.due) {  // whether the stage ends then or not
    forces = recurring.window.is_empty()
                 ? now
                 : recurring.window.means(contact::mean_grain_mass(model.state()));
  }
  const auto bodies = [](const contact::Force& force) {
    return std::minmax({grains::as_owner(force.upper), force.other});
  };
  std::set<std::pair<grains::Owner, grains::Owner>> there;
  const auto is_present = [&](grains::Owner body) {
    return !grains::is_particle(body) || model.state().particles[grains::particle_id(body)].present;
  };
  for (const contact::Force& force : now) {
    if (is_present(grains::as_owner(force.upper)) && is_present(force.other)) {
      there.insert(bodies(force));
    }
  }
  std::erase_if(forces,
                [&](const contact::Force& force) { return !there.contains(bodies(force)); });
  return forces;
}

ObserverFactory contacts_observer() {
  return observer_factory<ContactRecord>(is_contact_model);
}

double frame_bytes(const scene::Scene& scene, bool has_forces, double particles) {
  const double forces =
      has_forces ? grains::kListCapacityRatio * contact::kContactsPerGrain * sizeof(contact::Force)
                 : 0;
  return is_contact_model(scene) ? particles * (sizeof(Eigen::Vector2d) + sizeof(double) + forces)
                                 : 0;
}

}  // namespace clca::record
