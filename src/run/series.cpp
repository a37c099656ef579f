#include "run/series.hpp"

#include <algorithm>

#include "clca/measure/contacts.hpp"
#include "clca/measure/outflow.hpp"
#include "run/outlet_counts.hpp"

namespace clca::run {

namespace {

double mean_height(const grains::State& state) {
  double sum = 0;
  double weight = 0;
  for (const grains::Particle& particle : state.particles) {
    if (particle.present) {
      const auto sites = static_cast<double>(state.shape(particle).size());
      sum += sites * grains::centre(state, particle).y();
      weight += sites;
    }
  }
  return weight > 0 ? sum / weight : 0;
}

/// A column with a part of contact::EnergyExchange.
struct Exchange {
  const char* name;
  double contact::EnergyExchange::*part;
};

/// With what the scene has.
std::vector<Exchange> exchanges(const scene::Scene& scene) {
  std::vector<Exchange> result;
  if (!scene.sources.empty()) {
    result.push_back({"source_energy", &contact::EnergyExchange::sources});
  }
  if (!scene.outlets.empty()) {
    result.push_back({"outlet_energy", &contact::EnergyExchange::outlets});
  }
  if (std::any_of(scene.walls.begin(), scene.walls.end(),
                  [](const scene::Wall& wall) { return wall.motion.has_value(); })) {
    result.push_back({"wall_work", &contact::EnergyExchange::walls});
  }
  if (has_vessel(scene)) {
    result.push_back({"vessel_work", &contact::EnergyExchange::vessel});
  }
  return result;
}

std::vector<std::string> columns(const scene::Scene& scene) {
  std::vector<std::string> names = {"step",
                                    "stage",
                                    "particles",
                                    "moving",
                                    "moving_share",
                                    "mean_height",
                                    "discharged_particles",
                                    "discharged_sites"};
  if (scene.model == scene::Model::contact) {
    names.insert(names.begin() + 1, "time");
    names.insert(names.end(), {"kinetic_energy", "potential_energy", "dissipated_energy"});
    for (const Exchange& exchange : exchanges(scene)) {
      names.emplace_back(exchange.name);
    }
  }
  if (has_vessel(scene)) {
    names.emplace_back("vessel_angle_deg");
  }
  for (const scene::Wall& wall : scene.walls) {
    if (wall.motion) {
      names.push_back("travel." + wall.name);
    }
    if (wall.motion && wall.passive == grains::Passive::overlap) {
      names.push_back("index." + wall.name);
    }
  }
  const std::vector<std::string> discharged = discharge_names(scene);
  names.insert(names.end(), discharged.begin(), discharged.end());
  return names;
}

/// Overlapping sites per wall: of all contacts that began there.
std::vector<std::uint64_t> indices(const Model& model) {
  const grains::State& state = model.state();
  std::vector<std::uint64_t> sites(state.walls.size(), 0);
  if (state.pushes.empty()) {
    return sites;
  }
  for (const measure::OverlapContact& contact :
       measure::contacts(state, model.grains().occupancy())) {
    if (contact.source) {
      sites[*contact.source] += static_cast<std::uint64_t>(contact.sites);
    }
  }
  return sites;
}

}  // namespace

SeriesTable::SeriesTable(const scene::Scene& scene)
    : scene_(scene),
      conversion_(scene::conversion(scene)),
      has_vessel_(has_vessel(scene)),
      table_(columns(scene)) {}

bool SeriesTable::add(const std::string& stage, const Model& model, const Records& records,
                      std::size_t moving, bool always) {
  const grains::State& state = model.state();
  if ((!always && state.step % scene_.output.series->every != 0) || last_step_ == state.step) {
    return false;
  }
  last_step_ = state.step;
  const std::uint64_t present = grains::present_count(state);
  const measure::Discharge out = measure::discharge(state);
  const double share =
      present > 0 ? static_cast<double>(moving) / static_cast<double>(present) : 0.0;
  std::vector<store::Cell> cells = {
      state.step,         stage,         present,  std::uint64_t{moving}, share,
      mean_height(state), out.particles, out.sites};
  if (conversion_) {
    cells.insert(cells.begin() + 1, conversion_->time(state.step));
  }
  if (const auto energy = model.energy()) {
    cells.insert(cells.end(),
                 {energy->kinetic, energy->potential, records.energy()->dissipated(*energy)});
    for (const Exchange& exchange : exchanges(scene_)) {
      cells.emplace_back(records.energy()->exchanged().*exchange.part);
    }
  }
  if (has_vessel_) {
    cells.emplace_back(contact::degrees(model.vessel().angle));
  }
  const std::vector<std::uint64_t> sites = indices(model);
  for (std::size_t wall = 0; wall < state.walls.size(); ++wall) {
    if (state.walls[wall].motion) {
      cells.emplace_back(static_cast<double>(state.walls[wall].travel.offset));
    }
    if (state.walls[wall].lets_overlap()) {
      cells.emplace_back(sites[wall]);
    }
  }
  if (!discharge_names(scene_).empty()) {
    const auto particles = measure::discharged_particles(state, scene_.species.size());
    for (const std::uint64_t count : discharge_values(scene_, particles)) {
      cells.emplace_back(count);
    }
  }
  table_.add_row(std::move(cells));
  return true;
}

}  // namespace clca::run
