// series.csv and probes.csv: the time series of a run, and what the probes of the scene see.

#include <algorithm>
#include <iterator>

#include "clca/measure/field_grid.hpp"
#include "clca/measure/force.hpp"
#include "clca/measure/outflow.hpp"
#include "clca/scene/units.hpp"
#include "record/energy_record.hpp"
#include "record/internal/quantities.hpp"
#include "record/series_record.hpp"

namespace clca::record {

namespace {

/// None of an empty box.
std::optional<double> mean_height(const grains::State& state) {
  double sum = 0;
  double weight = 0;
  for (const grains::Particle& particle : state.particles) {
    if (particle.present) {
      const auto sites = static_cast<double>(state.shape(particle).size());
      sum += sites * grains::centre(state, particle).y();
      weight += sites;
    }
  }
  return weight > 0 ? std::optional(sum / weight) : std::nullopt;
}

/// What a row is made of.
struct SeriesRow {
  const StageView& now;
  contact::Energy energy = {};           ///< of the contact model
  const EnergyRecord* record = nullptr;  ///< likewise
  const SeriesRecord* since = nullptr;   ///< since the last row

  const grains::State& state() const { return now.model.state(); }
};

double moving_share(const StageView& now) {
  return now.stepped > 0 ? static_cast<double>(now.moving) / static_cast<double>(now.stepped) : 0.0;
}

using scene::kEnergyUnit;
constexpr std::string_view kSinceStage = "since the start of the stage";
constexpr std::string_view kSinceRow = "by all outlets, since the last row";
constexpr std::string_view kSinceRun = "by all outlets, since the start of the run";

TableOf<SeriesRow> series_table(const scene::Scene& scene) {
  return {
      {.name = "series",
       .of_each = {{{"travel", "Travel of the wall", "sites",
                     "from home, along its motion; of each that moves"},
                    "WALL"},
                   {{"index", "Overlap of the wall", "sites",
                     "in all contacts that began at it; with `passive: overlap`"},
                    "WALL"},
                   {{"discharged", "Particles discharged", "particles",
                     "by it, since the start of the run; with several outlets"},
                    "OUTLET"},
                   {{"discharged", "Particles discharged", "particles",
                     "those of a species; with several species"},
                    "OUTLET.SPECIES"},
                   {{"force_x", "Force on the wall, x", scene::kForceUnit,
                     "of the grains on it, in the frame of the vessel, mean since the last row; "
                     "with `forces`, of each wall and of `box.floor`, `box.top`, `box.left`, "
                     "`box.right`"},
                    "WALL"},
                   {{"force_y", "Force on the wall, y", scene::kForceUnit, "likewise"}, "WALL"},
                   {{"torque", "Torque on the wall", scene::kMomentUnit,
                     "likewise, anticlockwise, about its centroid; in a stage that turns the "
                     "vessel about the centre of turning"},
                    "WALL"}}},
      {{kStep, [](auto& row) { return row.state().step; }},
       {kStage, [](auto& row) { return row.now.stage.name; }},
       {{"particles", "Particles", "particles", "in the box"},
        [](auto& row) { return grains::present_count(row.state()); }},
       {{"moving", "Moving", "particles",
         "that moved by themselves or were pushed out of an overlap in this step, those removed "
         "at its end included; not those that a rigid wall carries"},
        [](auto& row) { return row.now.moving; }},
       {{"moving_share", "Share moving", "",
         "of the particles, in this step, those removed at its end included"},
        [](auto& row) { return moving_share(row.now); }},
       {{"mean_height", "Mean height of the particles", "spacings",
         "of their centres, weighted by sites"},
        [](auto& row) { return mean_height(row.state()); }},
       {{"discharged_particles", "Particles discharged", "particles", kSinceRun},
        [](auto& row) { return measure::discharge(row.state()).particles; }},
       {{"discharged_sites", "Sites discharged", "sites", kSinceRun},
        [](auto& row) { return measure::discharge(row.state()).sites; }}},
      {{kContactModel,
        is_contact(scene),
        {{{"kinetic_energy", "Kinetic energy", kEnergyUnit, "with spin"},
          [](auto& row) { return row.energy.kinetic; }},
         {{"potential_energy", "Potential energy", kEnergyUnit, ""},
          [](auto& row) { return row.energy.potential; }},
         {{"dissipated_energy", "Dissipated energy", kEnergyUnit, kSinceStage},
          [](auto& row) { return row.record->dissipated(row.energy); }}}},
       {"with `model: contact` and sources",
        is_contact(scene) && !scene.sources.empty(),
        {{{"source_energy", "Energy from sources", kEnergyUnit, kSinceStage},
          [](auto& row) { return row.record->exchanged().sources; }}}},
       {"with `model: contact` and outlets",
        is_contact(scene) && !scene.outlets.empty(),
        {{{"outlet_energy", "Energy through outlets", kEnergyUnit, kSinceStage},
          [](auto& row) { return row.record->exchanged().outlets; }}}},
       {"with `model: contact` and walls that move",
        is_contact(scene) &&
            std::ranges::any_of(scene.walls,
                                [](const scene::Wall& wall) { return wall.motion.has_value(); }),
        {{{"wall_work", "Work of walls", kEnergyUnit, kSinceStage},
          [](auto& row) { return row.record->exchanged().walls; }}}},
       {"with `units.density` and outlets",
        has_flow_rates(scene),
        {{{"mass_flow_rate", "Mass flow rate", "kg/s", kSinceRow},
          [](auto& row) { return row.since->mass_flow_rate(); }},
         {{"particle_flow_rate", "Particle flow rate", "particles/s", kSinceRow},
          [](auto& row) { return row.since->particle_flow_rate(); }}}},
       {"with a vessel in some stage",
        model::has_vessel(scene),
        {{{"vessel_work", "Work of the vessel", kEnergyUnit, kSinceStage},
          [](auto& row) { return row.record->exchanged().vessel; }},
         {kVesselAngle,
          [](auto& row) { return contact::degrees(row.now.model.vessel().angle); }}}}}};
}

/// Of each wall and outlet, KEY.NAME.
std::vector<std::string> names_of_each(const scene::Scene& scene) {
  std::vector<std::string> names;
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
  if (scene.output.series->forces) {
    const std::vector<std::string> forces = SeriesRecord::force_names(scene);
    names.insert(names.end(), forces.begin(), forces.end());
  }
  return names;
}

/// Overlapping sites per wall: of all contacts that began there.
std::vector<std::uint64_t> indices(const model::SceneModel& model) {
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

std::vector<store::Cell> cells_of_each(const SeriesRow& row) {
  const scene::Scene& scene = row.now.scene;
  const grains::State& state = row.state();
  std::vector<store::Cell> cells;
  const std::vector<std::uint64_t> sites = indices(row.now.model);
  for (std::size_t wall = 0; wall < state.walls.size(); ++wall) {
    if (state.walls[wall].motion) {
      cells.emplace_back(static_cast<double>(state.walls[wall].travel.offset));
    }
    if (state.walls[wall].lets_overlap()) {
      cells.emplace_back(sites[wall]);
    }
  }
  if (!discharge_names(scene).empty()) {
    const auto particles = measure::discharged_particles(state, scene.species.size());
    for (const std::uint64_t count : discharge_values(scene, particles)) {
      cells.emplace_back(count);
    }
  }
  if (scene.output.series->forces) {
    const std::vector<store::Cell> forces = row.since->force_cells();
    cells.insert(cells.end(), forces.begin(), forces.end());
  }
  return cells;
}

struct ProbeRow {
  const StageView& now;
  const scene::Probe& probe;
  double filling = 0;
  double particles = 0;
  std::optional<Eigen::Vector2d> velocity = {};
  std::optional<double> fluctuation = {};
  std::optional<double> flow = {};
  std::optional<double> mass_flow = {};
};

TableOf<ProbeRow> probes_table(const scene::Scene& scene) {
  return {{.name = "probes"},
          {{kStep, [](auto& row) { return row.now.model.state().step; }},
           {kStage, [](auto& row) { return row.now.stage.name; }},
           {{"probe", "Probe", "", "its name"}, [](auto& row) { return row.probe.name; }},
           {{"filling", "Filling", "",
             "share of its sites that particles cover, of those without wall"},
            &ProbeRow::filling},
           {{"particles", "Particles", "particles", "that the next three are over"},
            &ProbeRow::particles},
           {kVelocity, &ProbeRow::velocity},
           {kFluctuation, &ProbeRow::fluctuation},
           {{"flow", "Flow", "sites/step",
             "since the last row, of the particles whose centre has passed the horizontal middle "
             "line of the probe downwards, less those that have passed it upwards"},
            &ProbeRow::flow}},
          {{"with `units.density`",
            scene::has_density(scene),
            {{{"mass_flow", "Mass flow", "kg/s", "`flow` in SI units"}, &ProbeRow::mass_flow}}}}};
}

/// Of the automaton, motion is over the steps since the last row, of the particles that were in the
/// probe then; of the contact model, it is that at the row.
class Probes {
 public:
  explicit Probes(const scene::Scene& scene) : table_(table_scope(scene), probes_table(scene)) {}

  /// Adds a row for each probe.
  void add(const StageView& now);
  TableWriter<ProbeRow>& table() { return table_; }
  /// At the last row.
  std::optional<measure::Snapshot>& last() { return last_; }

 private:
  std::optional<measure::Snapshot> last_;
  TableWriter<ProbeRow> table_;
};

void Probes::add(const StageView& now) {
  const grains::State& state = now.model.state();
  const double steps = last_ ? static_cast<double>(state.step - last_->step()) : 0;
  const double speed = velocity_unit(now.scene);
  std::vector<measure::Displacement> displacements;
  if (is_contact(now.scene)) {
    displacements = measure::displacements_in_step(state, now.model.velocities());
  } else if (last_) {
    displacements = last_->displacements(state);
  }
  const std::vector<scene::Probe>& probes = now.scene.probes;
  std::vector<lattice::Rectangle> regions;
  std::ranges::transform(probes, std::back_inserter(regions),
                         [](const scene::Probe& probe) { return probe.region; });
  const std::vector<double> fillings = measure::fillings(state, regions);
  for (std::size_t i = 0; i < probes.size(); ++i) {
    ProbeRow row = {now, probes[i], fillings[i]};
    if (const auto motion =
            measure::motion_in(regions[i], displacements, is_contact(now.scene) ? 1 : steps)) {
      row.particles = motion->particles;
      row.velocity = motion->velocity * speed;
      row.fluctuation = motion->fluctuation * speed * speed;
    }
    if (last_) {
      row.flow = measure::downward_flow(*last_, state, regions[i]) / steps;
      if (scene::has_density(now.scene)) {
        row.mass_flow = scene::conversion(now.scene)->mass_rate(*row.flow);
      }
    }
    table_.add(row);
  }
  last_.emplace(state);
}

/// Rows at the steps that are due and at the begin and end of stages, one for each step.
class Series : public Observer {
 public:
  explicit Series(const scene::Scene& scene)
      : table_(table_scope(scene), series_table(scene), names_of_each(scene)) {
    if (!scene.probes.empty()) {
      probes_.emplace(scene);
    }
  }

  void begin_stage(const StageView& now) override { add_rows(now); }
  void after_step(const StageView& now) override {
    if (now.model.state().step % now.scene.output.series->every == 0) {
      add_rows(now);
    }
  }
  void end_stage(const StageView& now) override { add_rows(now); }
  void save(reflection::Columns& columns) override {
    reflection::encode(kPath, last_, columns);
    if (probes_) {
      reflection::encode(kProbesPath, probes_->last(), columns);
    }
  }
  void load(const SavedColumns& saved, const StageView& now) override {
    saved.read(kPath, last_, now.model.state());
    if (probes_) {
      saved.read(kProbesPath, probes_->last(), now.model.state());
    }
  }
  std::vector<RunTable*> tables() override {
    return probes_ ? std::vector<RunTable*>{&table_, &probes_->table()}
                   : std::vector<RunTable*>{&table_};
  }

 private:
  static constexpr const char* kPath = "outputs/series_step";
  static constexpr const char* kProbesPath = "outputs/probes";

  void add_rows(const StageView& now) {
    if (last_ == now.model.state().step) {
      return;
    }
    last_ = now.model.state().step;
    const contact::ContactModel* contact = now.model.contact();
    const SeriesRow row = {now, contact != nullptr ? contact->energy() : contact::Energy(),
                           now.observers.find<EnergyRecord>(), now.observers.find<SeriesRecord>()};
    table_.add(row, cells_of_each(row));
    if (probes_) {
      probes_->add(now);
    }
  }

  std::optional<std::uint64_t> last_;  // step that has a row
  TableWriter<SeriesRow> table_;
  std::optional<Probes> probes_;
};

}  // namespace

ObserverKind series_observer() {
  return observer_kind<Series>(
      [](const scene::Scene& scene) { return scene.output.series.has_value(); },
      {series_table, probes_table});
}

}  // namespace clca::record
