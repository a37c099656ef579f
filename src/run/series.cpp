#include "run/series.hpp"

#include <algorithm>

#include "clca/measure/contacts.hpp"
#include "clca/measure/outflow.hpp"
#include "run/outlet_counts.hpp"
#include "run/quantities.hpp"

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

/// What a row is made of.
struct Moment {
  const scene::Scene& scene;
  const std::string& stage;
  const Model& model;
  const Records& records;
  std::size_t moving = 0;
  std::optional<contact::Energy> energy;  ///< of the contact model
};

struct Column {
  Quantity quantity;
  bool (*applies)(const scene::Scene& scene);
  store::Cell (*value)(const Moment& now);
};

bool always(const scene::Scene& /*scene*/) {
  return true;
}
bool is_contact(const scene::Scene& scene) {
  return scene.model == scene::Model::contact;
}
bool has_sources(const scene::Scene& scene) {
  return is_contact(scene) && !scene.sources.empty();
}
bool has_outlets(const scene::Scene& scene) {
  return is_contact(scene) && !scene.outlets.empty();
}
bool has_moving_walls(const scene::Scene& scene) {
  return is_contact(scene) &&
         std::any_of(scene.walls.begin(), scene.walls.end(),
                     [](const scene::Wall& wall) { return wall.motion.has_value(); });
}

double moving_share(const Moment& now) {
  const std::size_t all = grains::present_count(now.model.state());
  return all > 0 ? static_cast<double>(now.moving) / static_cast<double>(all) : 0.0;
}

template <double contact::EnergyExchange::*kPart>
store::Cell exchanged(const Moment& now) {
  return now.records.energy()->exchanged().*kPart;
}

constexpr std::string_view kEnergyUnit = "weights of a site × spacings";
constexpr std::string_view kSinceStage = "since the start of the stage";

// Those of the scene are in the table, in this order; behind them, those of walls and outlets.
const std::vector<Column>& all_columns() {
  using Exchange = contact::EnergyExchange;
  static const std::vector<Column> kColumns = {
      {{"step", "Step", "", ""},
       always,
       [](const Moment& now) -> store::Cell { return now.model.state().step; }},
      {{"time", "Time", "time", ""},
       is_contact,
       [](const Moment& now) -> store::Cell {
         return scene::conversion(now.scene)->time(now.model.state().step);
       }},
      {{"stage", "Stage", "", ""},
       always,
       [](const Moment& now) -> store::Cell { return now.stage; }},
      {{"particles", "Particles", "particles", "in the box"},
       always,
       [](const Moment& now) -> store::Cell {
         return std::uint64_t{grains::present_count(now.model.state())};
       }},
      {{"moving", "Moving", "particles", "in this step"},
       always,
       [](const Moment& now) -> store::Cell { return std::uint64_t{now.moving}; }},
      {{"moving_share", "Share moving", "", "of the particles, in this step"},
       always,
       [](const Moment& now) -> store::Cell { return moving_share(now); }},
      {{"mean_height", "Mean height of the particles", "spacings", "of their sites"},
       always,
       [](const Moment& now) -> store::Cell { return mean_height(now.model.state()); }},
      {{"discharged_particles", "Particles discharged", "particles", "since the start of the run"},
       always,
       [](const Moment& now) -> store::Cell {
         return measure::discharge(now.model.state()).particles;
       }},
      {{"discharged_sites", "Sites discharged", "sites", "since the start of the run"},
       always,
       [](const Moment& now) -> store::Cell {
         return measure::discharge(now.model.state()).sites;
       }},
      {{"kinetic_energy", "Kinetic energy", kEnergyUnit, ""},
       is_contact,
       [](const Moment& now) -> store::Cell { return now.energy->kinetic; }},
      {{"potential_energy", "Potential energy", kEnergyUnit, ""},
       is_contact,
       [](const Moment& now) -> store::Cell { return now.energy->potential; }},
      {{"dissipated_energy", "Dissipated energy", kEnergyUnit, kSinceStage},
       is_contact,
       [](const Moment& now) -> store::Cell {
         return now.records.energy()->dissipated(*now.energy);
       }},
      {{"source_energy", "Energy from sources", kEnergyUnit, kSinceStage},
       has_sources,
       exchanged<&Exchange::sources>},
      {{"outlet_energy", "Energy through outlets", kEnergyUnit, kSinceStage},
       has_outlets,
       exchanged<&Exchange::outlets>},
      {{"wall_work", "Work of walls", kEnergyUnit, kSinceStage},
       has_moving_walls,
       exchanged<&Exchange::walls>},
      {{"vessel_work", "Work of the vessel", kEnergyUnit, kSinceStage},
       has_vessel,
       exchanged<&Exchange::vessel>},
      {kVesselAngle, has_vessel, [](const Moment& now) -> store::Cell {
         return contact::degrees(now.model.vessel().angle);
       }}};
  return kColumns;
}

std::vector<std::string> columns(const scene::Scene& scene) {
  std::vector<std::string> names;
  for (const Column& column : all_columns()) {
    if (column.applies(scene)) {
      names.emplace_back(column.quantity.key);
    }
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

const std::vector<Quantity>& series_quantities() {
  static const std::vector<Quantity> kQuantities = [] {
    std::vector<Quantity> all = {
        {"travel", "Travel of the wall", "sites", "from home"},
        {"index", "Overlap of the wall", "sites", "in all contacts that began at it"}};
    for (const Column& column : all_columns()) {
      all.push_back(column.quantity);
    }
    return all;
  }();
  return kQuantities;
}

SeriesTable::SeriesTable(const scene::Scene& scene) : scene_(scene), table_(columns(scene)) {}

bool SeriesTable::add(const std::string& stage, const Model& model, const Records& records,
                      std::size_t moving, bool always) {
  const grains::State& state = model.state();
  if ((!always && state.step % scene_.output.series->every != 0) || last_step_ == state.step) {
    return false;
  }
  last_step_ = state.step;
  const Moment now = {scene_, stage, model, records, moving, model.energy()};
  std::vector<store::Cell> cells;
  for (const Column& column : all_columns()) {
    if (column.applies(scene_)) {
      cells.push_back(column.value(now));
    }
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
