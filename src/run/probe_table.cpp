#include "run/probe_table.hpp"

#include <algorithm>
#include <iterator>
#include <limits>

#include "clca/measure/probe.hpp"

namespace clca::run {

namespace {

std::vector<std::string> probe_columns(bool has_time) {
  std::vector<std::string> names = {"step", "stage", "probe",       "filling", "particles",
                                    "vx",   "vy",    "fluctuation", "flow"};
  if (has_time) {
    names.insert(names.begin() + 1, "time");
  }
  return names;
}

}  // namespace

ProbeTable::ProbeTable(const scene::Scene& scene)
    : probes_(scene.probes),
      conversion_(scene::conversion(scene)),
      table_(probe_columns(conversion_.has_value())) {}

void ProbeTable::add(const std::string& stage, const Model& model) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  const grains::State& state = model.state();
  const double steps = last_ ? static_cast<double>(state.step - last_->step()) : 0;
  const double speed = conversion_ ? conversion_->velocity(1) : 1;
  std::vector<measure::Displacement> displacements;
  if (conversion_) {
    displacements = measure::displacements_in_step(state, model.velocities());
  } else if (last_) {
    displacements = last_->displacements(state);
  }
  std::vector<lattice::Rectangle> regions;
  std::transform(probes_.begin(), probes_.end(), std::back_inserter(regions),
                 [](const scene::Probe& probe) { return probe.region; });
  const std::vector<double> fillings = measure::fillings(state, regions);
  for (std::size_t i = 0; i < probes_.size(); ++i) {
    const scene::Probe& probe = probes_[i];
    const auto motion = measure::motion_in(probe.region, displacements, conversion_ ? 1 : steps);
    std::vector<store::Cell> cells = {state.step, stage, probe.name, fillings[i],
                                      std::uint64_t{motion ? motion->particles : 0}};
    if (conversion_) {
      cells.insert(cells.begin() + 1, conversion_->time(state.step));
    }
    for (const double value :
         {motion ? motion->velocity.x() * speed : kNone,
          motion ? motion->velocity.y() * speed : kNone,
          motion ? motion->fluctuation * speed * speed : kNone,
          last_ ? measure::downward_flow(*last_, state, probe.region) / steps : kNone}) {
      cells.emplace_back(value);
    }
    table_.add_row(std::move(cells));
  }
  last_.emplace(state);
}

}  // namespace clca::run
