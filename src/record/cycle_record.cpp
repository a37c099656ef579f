#include "record/internal/cycle_record.hpp"

#include <algorithm>

#include "clca/measure/mixing.hpp"
#include "clca/measure/profile.hpp"
#include "record/internal/quantities.hpp"

namespace clca::record {

namespace {

TableOf<CycleRow> cycles_table(const scene::Scene& scene) {
  return {
      {.name = "cycles"},
      {{kStage, [](auto& row) { return row.now.stage.name; }},
       {{"cycle", "Cycle", "", "number of those completed in the stage; 0: before the first"},
        &CycleRow::cycle},
       {kStep, [](auto& row) { return row.state().step; }},
       {kHeightMean, [](auto& row) { return bed_height(row.profile); }},
       {kReposeAngle, [](auto& row) { return measure::repose_angle(row.profile).mean_degrees(); }},
       {kIntruderHeight, [](auto& row) { return measure::intruder_height(row.state()); }},
       {kSegregationIndex, [](auto& row) { return measure::segregation_index(row.state()); }},
       {kLaceyIndex, [](auto& row) { return measure::lacey_index(row.state(), row.cell_side); }}},
      {{"with a [vessel](#vessel), not in a periodic box",
        model::has_vessel(scene) && !scene.box.periodic,
        {{kReposeGravity, [](auto& row) {
            const auto down = contact::gravity_direction(row.now.model.vessel());
            return measure::repose_angle(measure::surface_profile(row.state(), down))
                .mean_degrees();
          }}}}}};
}

TableOf<measure::ConvectionArrow> convection_table(const scene::Scene& /*scene*/) {
  using measure::ConvectionArrow;
  return {{.name = "convection", .kind = TableInfo::Kind::parts},
          {{kCellCentre, &ConvectionArrow::centre},
           {{"d", "Drift", "spacings/cycle", "mean displacement"}, &ConvectionArrow::displacement},
           {{"weight", "Weight", "sites", "of the particles that it is over, of all cycles"},
            &ConvectionArrow::weight}}};
}

MeasureValues convection(const StageView& stage) {
  const measure::Convection* convection = stage.observers.find<CycleRecord>()->convection();
  if (convection == nullptr) {
    return {};
  }
  const auto rolls = convection->rolls();
  return rolls
             ? MeasureValues{rolls->centre_minus_wall, rolls->rotation_left, rolls->rotation_right}
             : MeasureValues(3);
}

bool has_cycles(const scene::Scene& scene, const scene::Stage& stage) {
  return scene::vessel_has_cycles(stage) ||
         std::ranges::any_of(stage.moving_walls, [&](std::size_t wall) {
           return grains::is_cyclic(*scene.walls[wall].motion);
         });
}

}  // namespace

CycleRecord::CycleRecord(const scene::Scene& scene)
    : cell_(scene.output.fields.value_or(scene::FieldOutput{}).cell_side),
      cycles_table_(scene, cycles_table(scene)),
      convection_table_(scene, convection_table(scene)) {}

double CycleRecord::bytes(const scene::Scene& scene, double particles) {
  const bool any = std::ranges::any_of(
      scene.stages, [&](const scene::Stage& stage) { return has_cycles(scene, stage); });
  return any ? 2 * measure::Snapshot::bytes_for(particles) +
                   particles * sizeof(measure::Displacement)
             : 0;
}

void CycleRecord::begin_stage(const StageView& now) {
  prepare(now);
  if (convection_) {
    convection_->begin_cycle(now.model.state());
    add_row(now);
  }
}

void CycleRecord::prepare(const StageView& now) {
  const grains::State& state = now.model.state();
  cycles_ = 0;
  at_start_.clear();
  for (const grains::Wall& wall : state.walls) {
    at_start_.push_back(wall.travel);
  }
  convection_.reset();
  if (has_cycles(now.scene, now.stage)) {
    convection_.emplace(state.lattice, cell_);
  }
}

bool CycleRecord::precedes(const grains::State& now) const {
  return at_start_.size() == now.walls.size() && (!convection_ || convection_->precedes(now));
}

void CycleRecord::after_step(const StageView& now) {
  const grains::State& state = now.model.state();
  if (!convection_) {
    return;
  }
  const std::uint64_t cycles = count_completed_cycles(now);
  if (cycles == cycles_) {
    return;
  }
  cycles_ = cycles;
  convection_->end_cycle(state);
  convection_->begin_cycle(state);
  add_row(now);
}

void CycleRecord::end_stage(const StageView& now) {
  if (convection_ && requests_measure(now.scene, scene::Measure::convection)) {
    for (const measure::ConvectionArrow& arrow : convection_->arrows()) {
      convection_table_.add(arrow);
    }
    convection_table_.write(now.output_folder, now.stage.name);
  }
}

std::uint64_t CycleRecord::count_completed_cycles(const StageView& now) const {
  const grains::State& state = now.model.state();
  std::optional<std::uint64_t> least;
  if (scene::vessel_has_cycles(now.stage)) {
    least = now.model.vessel().whole_cycles;
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

void CycleRecord::add_row(const StageView& now) {
  cycles_table_.add({.now = now,
                     .cycle = cycles_,
                     .profile = measure::surface_profile(now.model.state()),
                     .cell_side = cell_});
}

ObserverFactory cycles_observer() {
  return observer_factory<CycleRecord>(
      [](const scene::Scene& /*scene*/) { return true; }, {cycles_table, convection_table},
      {{scene::Measure::convection,
        "a wall with a wave or shake",
        {{"convection_centre_minus_wall", "Convection, centre less walls", "spacings/cycle",
          "rise inside less that at the walls"},
         {"convection_circulation_left", "Circulation, left half", "rad/cycle", "anticlockwise"},
         {"convection_circulation_right", "Circulation, right half", "rad/cycle", "anticlockwise"}},
        convection}});
}

}  // namespace clca::record
