// series.csv: the time series of a run.

#include <algorithm>
#include <cmath>
#include <limits>

#include "clca/contact/force.hpp"
#include "clca/measure/force.hpp"
#include "clca/measure/outflow.hpp"
#include "clca/scene/units.hpp"
#include "record/energy_record.hpp"
#include "record/internal/quantities.hpp"

namespace clca::record {

namespace {

/// Whether the series has what leaves in kilograms and particles a second.
bool has_flow_rates(const scene::Scene& scene) {
  return scene::has_density(scene) && !scene.outlets.empty();
}

Eigen::Vector2d centroid(const std::vector<lattice::Site>& sites) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (const lattice::Site site : sites) {
    sum += lattice::position(site);
  }
  return sites.empty() ? sum : Eigen::Vector2d(sum / static_cast<double>(sites.size()));
}

Eigen::Vector2d middle(const lattice::Lattice& box) {
  return lattice::Lattice::lower_left_corner() + box.extent() / 2;
}

/// The middle of a side of the box.
Eigen::Vector2d middle(const lattice::Lattice& box, grains::Owner side) {
  const double x = side == contact::kLeftSide ? -0.5 : side == contact::kRightSide ? 0.5 : 0;
  const double y = side == contact::kFloor ? -0.5 : side == contact::kCeiling ? 0.5 : 0;
  return middle(box) + box.extent().cwiseProduct(Eigen::Vector2d(x, y));
}

/// From one point to another; in a periodic box to its nearest image.
Eigen::Vector2d lever(const lattice::Lattice& box, const Eigen::Vector2d& from,
                      const Eigen::Vector2d& to) {
  return box.image_in_box(to - from + middle(box)) - middle(box);
}

/// What series.csv says of the steps since its last row: forces on walls, and what has left.
class StepsSinceRow {
 public:
  explicit StepsSinceRow(const scene::Scene& scene)
      : series_(*scene.output.series), conversion_(scene::unit_conversion(scene)) {
    if (series_.has_wall_forces) {
      bodies_ = walls_and_sides(scene);
    }
  }

  void begin_stage(const StageView& now) {
    const grains::State& state = now.model.state();
    left_ = measure::discharge(state);  // its fill may be in outlets
    clear();
    centre_ = scene::turning_centre(now.scene, now.stage);
    centres_.clear();
    for (const grains::Owner body : bodies_) {
      centres_.push_back(contact::is_side(body)
                             ? middle(state.lattice, body)
                             : centroid(state.walls[grains::wall_number(body)].sites));
    }
  }
  void add_step(const StageView& now) {
    const grains::State& state = now.model.state();
    ++steps_;
    left_ = measure::discharge(state);
    if (series_.has_wall_forces) {
      add_forces(state, now.model.wall_forces());
    }
  }

  /// Names of the columns of the forces: of each wall, then each side of the box.
  static std::vector<std::string> force_names(const scene::Scene& scene) {
    std::vector<std::string> names;
    for (const grains::Owner body : walls_and_sides(scene)) {
      for (const char* key : {"force_x.", "force_y.", "torque."}) {
        names.push_back(key + body_name(scene, body));
      }
    }
    return names;
  }
  /// Their cells; no values without steps.
  std::vector<store::Cell> force_cells() const {
    std::vector<store::Cell> cells;
    const auto add = [&](double sum, std::string_view unit) {
      cells.emplace_back(steps_ > 0 ? conversion_->in_si(sum / static_cast<double>(steps_), unit)
                                    : std::numeric_limits<double>::quiet_NaN());
    };
    for (const Load& load : loads_) {
      add(load.force_x, scene::kForceUnit);
      add(load.force_y, scene::kForceUnit);
      add(load.torque, scene::kMomentUnit);
    }
    return cells;
  }
  /// Kilograms and particles a second; none without steps.
  std::optional<double> mass_flow_rate() const {
    return steps_ > 0 ? std::optional(static_cast<double>(left_.sites - before_.sites) *
                                      conversion_->site_mass->mass / conversion_->time(steps_))
                      : std::nullopt;
  }
  std::optional<double> particle_flow_rate() const {
    return steps_ > 0 ? std::optional(static_cast<double>(left_.particles - before_.particles) /
                                      conversion_->time(steps_))
                      : std::nullopt;
  }

  /// After a row.
  void clear() {
    steps_ = 0;
    loads_.assign(bodies_.size(), {});
    before_ = left_;
  }

  bool precedes(const grains::State& now) const {
    const auto up_to = [](const measure::Discharge& one, const measure::Discharge& later) {
      return one.particles <= later.particles && one.sites <= later.sites;
    };
    return loads_.size() == bodies_.size() && up_to(before_, left_) &&
           up_to(left_, measure::discharge(now)) &&
           std::ranges::all_of(loads_, [](const Load& load) {
             return std::isfinite(load.force_x) && std::isfinite(load.force_y) &&
                    std::isfinite(load.torque);
           });
  }
  CLCA_FIELDS(steps_, loads_, before_, left_);

 private:
  /// On a wall or a side, summed over the steps, in weights of a site and lattice spacings.
  struct Load {
    double force_x = 0;
    double force_y = 0;
    double torque = 0;  // anticlockwise

    CLCA_FIELDS(force_x, force_y, torque);
  };

  void add_forces(const grains::State& state, const std::vector<contact::Force>& forces) {
    const double mass = contact::mean_grain_mass(state);
    for (const contact::Force& force : forces) {
      const auto found = std::ranges::find(bodies_, force.other);
      if (found == bodies_.end()) {
        continue;  // a grain
      }
      const auto body = static_cast<std::size_t>(found - bodies_.begin());
      const Eigen::Vector2d on_body = -mass * force.on_upper();
      const Eigen::Vector2d arm = lever(state.lattice, pivot(state, body), force.point);
      loads_[body].force_x += on_body.x();
      loads_[body].force_y += on_body.y();
      loads_[body].torque += arm.x() * on_body.y() - arm.y() * on_body.x();
    }
  }
  /// What the torque on a body is about.
  Eigen::Vector2d pivot(const grains::State& state, std::size_t body) const {
    if (centre_) {
      return *centre_;
    }
    const Eigen::Vector2d home = centres_[body];
    return contact::is_side(bodies_[body])
               ? home
               : home + lattice::position(state.walls[grains::wall_number(bodies_[body])].shift());
  }

  scene::SeriesOutput series_;
  std::optional<scene::UnitConversion> conversion_;  // of units; none: steps have no length
  std::vector<grains::Owner> bodies_;                // with forces; else empty
  std::vector<Eigen::Vector2d> centres_;             // of each, before walls travelled
  std::optional<Eigen::Vector2d> centre_;            // that the vessel turns about
  std::uint64_t steps_ = 0;
  std::vector<Load> loads_;    // by body
  measure::Discharge before_;  // what had left the box at the last row
  measure::Discharge left_;    // what had left it after the last step
};

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
  const StepsSinceRow& since_row;
  contact::Energy energy = {};            ///< of the contact model
  const EnergyRecord* balance = nullptr;  ///< of the energy, likewise

  const grains::State& state() const { return now.model.state(); }
};

double moving_share(const StageView& now) {
  return now.stepped_particles > 0 ? static_cast<double>(now.moving_particles) /
                                         static_cast<double>(now.stepped_particles)
                                   : 0.0;
}

using scene::kEnergyUnit;
constexpr std::string_view kSinceStage = "since the start of the stage";
constexpr std::string_view kSinceRow = "by all outlets, since the last row";
constexpr std::string_view kSinceRun = "by all outlets, since the start of the run";

TableOf<SeriesRow> series_table(const scene::Scene& scene) {
  return {
      {.name = "series",
       .columns =
           {{.quantity = {"travel", "Travel of the wall", "sites",
                          "from home, along its motion; of each that moves"},
             .of_each = "WALL"},
            {.quantity = {"index", "Overlap of the wall", "sites",
                          "in all contacts that began at it; with `passive: overlap`"},
             .of_each = "WALL"},
            {.quantity = {"discharged", "Particles discharged", "particles",
                          "by it, since the start of the run; with several outlets"},
             .of_each = "OUTLET"},
            {.quantity = {"discharged", "Particles discharged", "particles",
                          "those of a species; with several species"},
             .of_each = "OUTLET.SPECIES"},
            {.quantity =
                 {"force_x", "Force on the wall, x", scene::kForceUnit,
                  "of the grains on it, in the frame of the vessel, mean since the last row; "
                  "with `forces`, of each wall and of `box.floor`, `box.top`, `box.left`, "
                  "`box.right`"},
             .of_each = "WALL"},
            {.quantity = {"force_y", "Force on the wall, y", scene::kForceUnit,
                          "of the grains on it, in the frame of the vessel, mean since the last "
                          "row"},
             .of_each = "WALL"},
            {.quantity = {"torque", "Torque on the wall", scene::kMomentUnit,
                          "of the grains on it, mean since the last row, anticlockwise, about its "
                          "centroid; in a stage that turns the vessel about the centre of turning"},
             .of_each = "WALL"}}},
      {{kStep, [](auto& row) { return row.state().step; }},
       {kStage, [](auto& row) { return row.now.stage.name; }},
       {{"particles", "Particles", "particles", "in the box"},
        [](auto& row) { return grains::present_count(row.state()); }},
       {{"moving", "Moving", "particles",
         "that moved by themselves or were pushed out of an overlap in this step, those removed "
         "at its end included; not those that a rigid wall carries"},
        [](auto& row) { return row.now.moving_particles; }},
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
        is_contact_model(scene),
        {{{"kinetic_energy", "Kinetic energy", kEnergyUnit, "with spin"},
          [](auto& row) { return row.energy.kinetic; }},
         {{"potential_energy", "Potential energy", kEnergyUnit, ""},
          [](auto& row) { return row.energy.potential; }},
         {{"dissipated_energy", "Dissipated energy", kEnergyUnit, kSinceStage},
          [](auto& row) { return row.balance->dissipated_energy(row.energy); }}}},
       {"with `model: contact` and sources",
        is_contact_model(scene) && !scene.sources.empty(),
        {{{"source_energy", "Energy from sources", kEnergyUnit, kSinceStage},
          [](auto& row) { return row.balance->exchanged().sources; }}}},
       {"with `model: contact` and outlets",
        is_contact_model(scene) && !scene.outlets.empty(),
        {{{"outlet_energy", "Energy through outlets", kEnergyUnit, kSinceStage},
          [](auto& row) { return row.balance->exchanged().outlets; }}}},
       {"with `model: contact` and walls that move",
        is_contact_model(scene) &&
            std::ranges::any_of(scene.walls,
                                [](const scene::Wall& wall) { return wall.motion.has_value(); }),
        {{{"wall_work", "Work of walls", kEnergyUnit, kSinceStage},
          [](auto& row) { return row.balance->exchanged().walls; }}}},
       {"with `units.density` and outlets",
        has_flow_rates(scene),
        {{{"mass_flow_rate", "Mass flow rate", "kg/s", kSinceRow},
          [](auto& row) { return row.since_row.mass_flow_rate(); }},
         {{"particle_flow_rate", "Particle flow rate", "particles/s", kSinceRow},
          [](auto& row) { return row.since_row.particle_flow_rate(); }}}},
       {"with a vessel in some stage",
        model::has_vessel(scene),
        {{{"vessel_work", "Work of the vessel", kEnergyUnit, kSinceStage},
          [](auto& row) { return row.balance->exchanged().vessel; }},
         {kVesselAngle,
          [](auto& row) { return contact::to_degrees(row.now.model.vessel().angle); }}}}}};
}

/// Columns KEY.NAME of each wall and outlet.
std::vector<std::string> names_of_each(const scene::Scene& scene) {
  std::vector<std::string> names;
  for (const scene::Wall& wall : scene.walls) {
    if (wall.motion) {
      names.push_back("travel." + wall.name);
    }
    if (wall.motion && wall.passive_rule == grains::PassiveRule::overlap) {
      names.push_back("index." + wall.name);
    }
  }
  for (const auto& [name, none] : discharge_by_name(scene)) {
    names.push_back(name);
  }
  if (scene.output.series->has_wall_forces) {
    const std::vector<std::string> forces = StepsSinceRow::force_names(scene);
    names.insert(names.end(), forces.begin(), forces.end());
  }
  return names;
}

/// Overlapping sites per wall: of all contacts that began there.
std::vector<std::uint64_t> overlap_sites_by_wall(const model::SceneModel& model) {
  const grains::State& state = model.state();
  std::vector<std::uint64_t> sites(state.walls.size(), 0);
  if (state.pushes.empty()) {
    return sites;
  }
  for (const measure::OverlapContact& contact :
       measure::overlap_contacts(state, model.grains().occupancy())) {
    if (contact.source_wall) {
      sites[*contact.source_wall] += static_cast<std::uint64_t>(contact.shared_sites);
    }
  }
  return sites;
}

std::vector<store::Cell> cells_of_each(const SeriesRow& row) {
  const scene::Scene& scene = row.now.scene;
  const grains::State& state = row.state();
  std::vector<store::Cell> cells;
  const std::vector<std::uint64_t> sites = overlap_sites_by_wall(row.now.model);
  for (std::size_t wall = 0; wall < state.walls.size(); ++wall) {
    if (state.walls[wall].motion) {
      cells.emplace_back(static_cast<double>(state.walls[wall].travel.offset));
    }
    if (state.walls[wall].lets_overlap()) {
      cells.emplace_back(sites[wall]);
    }
  }
  if (!discharge_by_name(scene).empty()) {
    const auto particles = measure::discharged_counts(state, scene.species.size());
    for (const auto& [name, count] : discharge_by_name(scene, particles)) {
      cells.emplace_back(count);
    }
  }
  if (scene.output.series->has_wall_forces) {
    const std::vector<store::Cell> forces = row.since_row.force_cells();
    cells.insert(cells.end(), forces.begin(), forces.end());
  }
  return cells;
}

/// Rows at the steps that are due and at the begin and end of stages, one for each step.
class Series : public SavedObserver<Series> {
 public:
  explicit Series(const scene::Scene& scene)
      : since_row_(scene), table_(scene, series_table(scene), names_of_each(scene)) {}

  void begin_stage(const StageView& now) override {
    prepare(now);
    add_row(now);
  }
  void after_step(const StageView& now) override {
    since_row_.add_step(now);
    if (now.model.state().step % now.scene.output.series->every == 0) {
      add_row(now);
    }
  }
  void end_stage(const StageView& now) override { add_row(now); }
  std::vector<RunTable*> tables() override { return {&table_}; }

  bool precedes(const grains::State& now) const { return since_row_.precedes(now); }
  static constexpr const char* kPath = "outputs/series";
  CLCA_FIELDS(last_, since_row_);

 private:
  void prepare(const StageView& now) override { since_row_.begin_stage(now); }
  void add_row(const StageView& now) {
    if (last_ == now.model.state().step) {
      return;
    }
    last_ = now.model.state().step;
    const contact::ContactModel* contact = now.model.contact();
    const SeriesRow row = {now, since_row_,
                           contact != nullptr ? contact->energy() : contact::Energy(),
                           now.observers.find<EnergyRecord>()};
    table_.add(row, cells_of_each(row));
    since_row_.clear();
  }

  std::optional<std::uint64_t> last_;  // step that has a row
  StepsSinceRow since_row_;
  TableWriter<SeriesRow> table_;
};

}  // namespace

ObserverFactory series_observer() {
  return observer_factory<Series>(
      [](const scene::Scene& scene) { return scene.output.series.has_value(); }, {series_table});
}

}  // namespace clca::record
