#include "run/cycle_record.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "clca/measure/profile.hpp"
#include "clca/measure/segregation.hpp"
#include "run/model.hpp"

namespace clca::run {

namespace {

double value_or_nan(const std::optional<double>& value) {
  return value.value_or(std::numeric_limits<double>::quiet_NaN());
}

std::vector<std::string> cycle_columns(bool has_time, bool has_vessel) {
  std::vector<std::string> names = {"stage", "cycle", "step"};
  if (has_time) {
    names.emplace_back("time");
  }
  names.insert(names.end(), {"height_mean", "repose_angle_deg", "intruder_height_rel",
                             "segregation_index", "lacey_index"});
  if (has_vessel) {
    names.emplace_back("repose_gravity_deg");
  }
  return names;
}

}  // namespace

CycleRecord::CycleRecord(double cell, const scene::Scene& scene)
    : cell_(cell),
      conversion_(scene::conversion(scene)),
      has_vessel_(has_vessel(scene) && !scene.box.periodic),
      table_(cycle_columns(conversion_.has_value(), has_vessel_)) {}

void CycleRecord::begin_stage(const scene::Scene& scene, const scene::Stage& stage,
                              const grains::State& state, const contact::Vessel& vessel) {
  resume_stage(scene, stage, state);
  if (convection_) {
    convection_->begin_cycle(state);
    add_row(state, vessel);
  }
}

void CycleRecord::resume_stage(const scene::Scene& scene, const scene::Stage& stage,
                               const grains::State& state) {
  stage_ = stage.name;
  cycles_ = 0;
  at_start_.clear();
  for (const grains::Wall& wall : state.walls) {
    at_start_.push_back(wall.travel);
  }
  convection_.reset();
  const bool cyclic = std::any_of(stage.move.begin(), stage.move.end(), [&](std::size_t wall) {
    return grains::is_cyclic(*scene.walls[wall].motion);
  });
  vessel_has_cycles_ = scene::vessel_has_cycles(stage);
  if (cyclic || vessel_has_cycles_) {
    convection_.emplace(state.lattice, cell_);
  }
}

bool CycleRecord::precedes(const grains::State& now) const {
  return at_start_.size() == now.walls.size() && (!convection_ || convection_->precedes(now));
}

void CycleRecord::after_step(const grains::State& state, const contact::Vessel& vessel) {
  if (!convection_) {
    return;
  }
  const std::uint64_t cycles = completed(state, vessel.whole_cycles);
  if (cycles == cycles_) {
    return;
  }
  cycles_ = cycles;
  convection_->end_cycle(state);
  convection_->begin_cycle(state);
  add_row(state, vessel);
}

std::uint64_t CycleRecord::completed(const grains::State& state, std::uint64_t of_vessel) const {
  std::optional<std::uint64_t> least;
  if (vessel_has_cycles_) {
    least = of_vessel;
  }
  for (std::size_t number = 0; number < state.walls.size(); ++number) {
    const grains::Wall& wall = state.walls[number];
    if (!wall.motion || !wall.travel.active || !grains::is_cyclic(*wall.motion)) {
      continue;
    }
    const auto* wave = std::get_if<grains::Wave>(&wall.motion->program);
    const std::uint64_t cycles = wave != nullptr
                                     ? (wall.travel.clock - at_start_[number].clock) / wave->period
                                     : wall.travel.cycles - at_start_[number].cycles;
    least = std::min(least.value_or(cycles), cycles);
  }
  return least.value_or(0);
}

void CycleRecord::add_row(const grains::State& state, const contact::Vessel& vessel) {
  const std::vector<double> profile = measure::surface_profile(state);
  std::vector<store::Cell> cells = {stage_, cycles_, state.step};
  if (conversion_) {
    cells.emplace_back(conversion_->time(state.step));
  }
  cells.insert(cells.end(),
               {measure::mean_height(profile), value_or_nan(measure::repose_angle(profile).mean()),
                value_or_nan(measure::intruder_height(state)),
                value_or_nan(measure::segregation_index(state)),
                value_or_nan(measure::lacey_index(state, cell_))});
  if (has_vessel_) {
    const auto in_gravity = measure::surface_profile(state, contact::gravity_direction(vessel));
    cells.emplace_back(value_or_nan(measure::repose_angle(in_gravity).mean()));
  }
  table_.add_row(std::move(cells));
}

std::string CycleRecord::convection_csv() const {
  store::Table table({"x", "y", "dx", "dy", "weight"});
  for (const measure::Arrow& arrow : convection_->arrows()) {
    table.add_row({arrow.centre.x(), arrow.centre.y(), arrow.displacement.x(),
                   arrow.displacement.y(), arrow.weight});
  }
  return table.to_csv();
}

}  // namespace clca::run
