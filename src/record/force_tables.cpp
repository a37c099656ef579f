// Tables of contacts at the end of a stage. Those of the contact model are in weights of a grain of
// mean mass, those with walls that overlap particles in sites.

#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "clca/measure/field_grid.hpp"
#include "record/forces.hpp"
#include "record/internal/contact_record.hpp"
#include "record/internal/cycle_record.hpp"
#include "record/internal/quantities.hpp"

namespace clca::record {

namespace {

using Forces = std::vector<contact::Force>;
using Overlaps = std::vector<measure::OverlapContact>;

constexpr std::string_view kOverlap = "with `passive: overlap`";

/// A pair of bodies, the second of which may be a wall.
struct ContactRow {
  std::uint64_t first = 0;
  std::string second = {};
  std::optional<Eigen::Vector2d> point = {};
  const contact::Force* force = nullptr;
  int sites = 0;  ///< 0 if it is gone
  int depth = 0;
  std::string source = {};
  std::optional<double> mean_sites = {};
  std::optional<double> share = {};
};

TableOf<ContactRow> contacts_table(const scene::Scene& scene) {
  return {
      {.name = "contacts", .kind = TableInfo::Kind::parts},
      {{{"first", "First body", "", "id of a particle, of the contact model the upper one"},
        &ContactRow::first},
       {{"second", "Second body", "",
         "id of a particle, or name of a wall, `box.floor`, `box.top`, `box.left`, `box.right`"},
        &ContactRow::second},
       {{"", "Position", "spacings",
         "of the contact: on the side of the box, else on discs of the particles’ areas"},
        &ContactRow::point}},
      {{kContactModel,
        is_contact_model(scene),
        {{{"normal_", "Normal", "", "towards the first"},
          [](auto& row) { return row.force->normal; }},
         {{"normal_force", "Normal force", scene::kContactForceUnit, ""},
          [](auto& row) { return row.force->normal_force; }},
         {{"shear_force", "Shear force", scene::kContactForceUnit,
           "along the normal turned anticlockwise"},
          [](auto& row) { return row.force->shear_force; }}}},
       {kOverlap,
        has_overlaps(scene),
        {{{"sites", "Overlap", "sites", "that both share"}, &ContactRow::sites},
         {{"depth", "Depth of the overlap", "moves", "that would take it back"},
          &ContactRow::depth},
         {{"source", "Source", "", "the wall where the push began"}, &ContactRow::source},
         {{"mean_sites", "Mean overlap", "sites",
           "over the samples of `output.contacts`; of pairs that are gone this and the next only"},
          &ContactRow::mean_sites},
         {{"share", "Share of the samples", "", "with this contact"}, &ContactRow::share}}}}};
}

TableOf<measure::ForceBin> forces_table(const scene::Scene& scene) {
  using Bin = measure::ForceBin;
  const std::string_view unit = is_contact_model(scene) ? scene::kContactForceUnit : "sites";
  return {
      {.name = "forces", .kind = TableInfo::Kind::parts},
      {{{"low", "Lower end of the bin", unit,
         "of the index of force; of the contact model of normal forces between grains, in grain "
         "weights"},
        &Bin::low},
       {{"high", "Upper end of the bin", unit, "as the lower end"}, &Bin::high},
       {{"count", "Contacts", "", "in the bin"}, &Bin::count},
       {{"density", "Probability density", "", "of f/⟨f⟩"}, &Bin::density}}};
}

struct LoadRow {
  std::uint64_t id;
  std::string species;
  Eigen::Vector2d centre;
  double contacts = 0;  ///< of the contact model a mean over steps
  double load = 0;      ///< sum of normal forces, or of sites
  double residual = 0;
};

TableOf<LoadRow> loads_table(const scene::Scene& scene) {
  return {{.name = "loads", .kind = TableInfo::Kind::parts},
          {{{"id", "Particle", "", "its number; with `passive: overlap` of those that overlap"},
            &LoadRow::id},
           {{"species", "Species", "", "its name"}, &LoadRow::species},
           {{"", "Position", "spacings", "of the centre of mass"}, &LoadRow::centre}},
          {{kContactModel,
            is_contact_model(scene),
            {{{"contacts", "Contacts", "", "mean number"}, &LoadRow::contacts},
             {{"normal_force", "Normal force", scene::kContactForceUnit, "sum over its contacts"},
              &LoadRow::load},
             {{"residual", "Balance of forces", "",
               "what forces and weight do not balance, over the weight"},
              &LoadRow::residual}}},
           {kOverlap,
            has_overlaps(scene),
            {{{"sites", "Overlap", "sites", "shared, in all its contacts"}, &LoadRow::load},
             {{"pushes", "Pushes", "", "onto it"}, &LoadRow::contacts}}}}};
}

/// A wall or a side of the box. The base: of a wall that may overlap particles.
struct WallRow : measure::WallOverlap {
  std::string name = {};
  double contacts = 0;
  Eigen::Vector2d force = Eigen::Vector2d::Zero();
  std::optional<double> across = {};  // of a straight wall
  std::optional<double> along = {};
  std::optional<double> depth = {};
};

TableOf<WallRow> walls_table(const scene::Scene& scene) {
  return {
      {.name = "walls", .kind = TableInfo::Kind::parts},
      {{{"wall", "Wall", "",
         "its name, of the contact model also `box.floor`, `box.top`, `box.left`, `box.right`; "
         "else of those that move"},
        &WallRow::name}},
      {{kContactModel,
        is_contact_model(scene),
        {{{"contacts", "Contacts", "", "mean number"}, &WallRow::contacts},
         {{"force_", "Force on the wall", scene::kContactForceUnit, ""}, &WallRow::force},
         {{"normal_force", "Normal force on the wall", scene::kContactForceUnit,
           "across it, of a straight wall and of the sides"},
          &WallRow::across},
         {{"shear_force", "Shear force on the wall", scene::kContactForceUnit,
           "along it, towards its lower end, or to the right"},
          &WallRow::along}}},
       {kOverlap,
        has_overlaps(scene),
        {{{"travel", "Travel of the wall", "sites", "from home"},
          [](auto& row) { return static_cast<double>(row.travel); }},
         {{"depth", "Depth of the wall", "spacings", "under the surface at the start of the stage"},
          &WallRow::depth},
         {{"stalled_since", "Stalled since", "step", "since when it wants to go on and cannot"},
          &WallRow::stalled_since},
         {{"stalls", "Stalls", "", ""}, &WallRow::stalls},
         {{"particles", "Particles", "particles", "that overlap with the wall"},
          &WallRow::overlapping_particles},
         {{"sites", "Overlap", "sites", "of the wall with particles"}, &WallRow::shared_sites},
         {{"chain_sites", "Overlap in chains", "sites", "in all contacts that began at it"},
          &WallRow::chain_sites},
         {{"jammed", "Jammed", "particles", "pushed from this wall and at rest"},
          &WallRow::jammed_particles}}}}};
}

TableOf<measure::StressCell> stress_table(const scene::Scene& /*scene*/) {
  using Cell = measure::StressCell;
  constexpr std::string_view kUnit = scene::kStressUnit;
  return {{.name = "stress", .kind = TableInfo::Kind::parts},
          {{kCellCentre, &Cell::centre},
           {{"xx", "Stress, xx", kUnit, "pressed positive"}, &Cell::xx},
           {{"xy", "Stress, xy", kUnit, "of the symmetric part"}, &Cell::xy},
           {{"yy", "Stress, yy", kUnit, "pressed positive"}, &Cell::yy},
           {{"pressure", "Pressure", kUnit, "half of xx + yy"}, &Cell::pressure}}};
}

/// Row of a particle, without its balance of forces.
LoadRow load_row(const StageView& now, std::size_t id, double contacts, double load) {
  const grains::State& state = now.model.state();
  const grains::Particle& particle = state.particles[id];
  return {.id = id,
          .species = now.scene.species[state.kinds[particle.kind].species].name,
          .centre = grains::centre_in_box(state, particle),
          .contacts = contacts,
          .load = load};
}

/// Downwards, or to the right.
std::optional<Eigen::Vector2d> direction_of(const scene::WallPart& part) {
  const auto* line = std::get_if<lattice::Segment>(&part);
  if (line != nullptr && line->from != line->to) {
    const Eigen::Vector2d unit = (line->to - line->from).normalized();
    return unit.y() > 0 || (unit.y() == 0 && unit.x() < 0) ? -unit : unit;
  }
  if (const auto* box = std::get_if<lattice::Rectangle>(&part)) {
    const bool stands = box->right - box->left < box->top - box->bottom;
    return stands ? Eigen::Vector2d(0, -1) : Eigen::Vector2d(1, 0);
  }
  return std::nullopt;
}

/// Unit vector along a wall of parallel parts or a side of the box, down or to the right; or none.
std::optional<Eigen::Vector2d> direction_of(const scene::Scene& scene, grains::Owner body) {
  constexpr double kParallel = 1e-9;
  if (contact::is_side(body)) {
    const bool stands = body == contact::kLeftSide || body == contact::kRightSide;
    return stands ? Eigen::Vector2d(0, -1) : Eigen::Vector2d(1, 0);
  }
  std::optional<Eigen::Vector2d> all;
  for (const scene::WallPart& part : scene.walls[grains::wall_number(body)].parts) {
    const auto direction = direction_of(part);
    if (!direction || (all && (*all - *direction).norm() > kParallel)) {
      return std::nullopt;
    }
    all = direction;
  }
  return all;
}

class ForceTables : public Observer {
 public:
  explicit ForceTables(const scene::Scene& scene)
      : contacts_(scene, contacts_table(scene)),
        forces_(scene, forces_table(scene)),
        loads_(scene, loads_table(scene)),
        walls_(scene, walls_table(scene)) {
    if (is_contact_model(scene)) {
      stress_.emplace(scene, stress_table(scene));
    }
  }

  static double bytes(const scene::Scene& scene, double particles) {
    const double contacts = contact::kContactsPerGrain * particles;
    return contacts_table(scene).bytes(contacts) + loads_table(scene).bytes(particles) +
           frame_bytes(scene, true, particles);
  }

  void end_stage(const StageView& now) override {
    for (RunTable* table : tables()) {
      table->set_mean_mass(contact::mean_grain_mass(now.model.state()));
    }
    if (const auto* contacts = now.observers.find<ContactRecord>()) {
      add_forces(now, contacts->stage_mean_forces(now.model));
    } else {
      add_overlaps(now, *now.observers.find<OverlapRecord>());
    }
    for (RunTable* table : tables()) {
      table->write(now.output_folder, now.stage.name);
    }
  }
  std::vector<RunTable*> tables() override {
    std::vector<RunTable*> all = {&contacts_, &forces_, &loads_, &walls_};
    if (stress_) {
      all.push_back(&*stress_);
    }
    return all;
  }

 private:
  void add_forces(const StageView& now, const Forces& forces) {
    for (const contact::Force& force : forces) {
      contacts_.add({.first = force.upper,
                     .second = body_name(now.scene, force.other),
                     .point = force.point,
                     .force = &force});
    }
    add_bins(normal_force_distribution(forces));
    add_loads(now, forces);
    add_walls(now.scene, forces);
    const double cell = now.observers.find<CycleRecord>()->cell_side();
    for (const measure::StressCell& stress :
         measure::stress_field(now.model.state(), forces, cell)) {
      if (stress.xx != 0 || stress.xy != 0 || stress.yy != 0) {
        stress_->add(stress);
      }
    }
  }
  void add_loads(const StageView& now, const Forces& forces) {
    const grains::State& state = now.model.state();
    std::vector<double> contacts(state.particles.size(), 0);
    for (const contact::Force& force : forces) {
      contacts[force.upper] += force.share;
      if (grains::is_particle(force.other)) {
        contacts[grains::particle_id(force.other)] += force.share;
      }
    }
    const std::vector<double> loads = contact::normal_loads(state.particles.size(), forces);
    const std::vector<double> residuals =
        contact::force_residuals(state, forces, gravity_direction(now.model.vessel()));
    for (std::size_t id = 0; id < loads.size(); ++id) {
      if (state.particles[id].present) {
        LoadRow row = load_row(now, id, contacts[id], loads[id]);
        row.residual = residuals[id];
        loads_.add(row);
      }
    }
  }
  void add_walls(const scene::Scene& scene, const Forces& forces) {
    std::map<grains::Owner, WallRow> rows;
    for (const grains::Owner body : walls_and_sides(scene)) {
      rows[body].name = body_name(scene, body);
    }
    for (const contact::Force& force : forces) {
      if (!grains::is_particle(force.other)) {
        WallRow& row = rows[force.other];
        row.contacts += force.share;
        row.force -= force.on_upper();
      }
    }
    for (auto& [owner, row] : rows) {
      if (const auto along = direction_of(scene, owner)) {
        row.along = row.force.dot(*along);
        row.across = std::abs(row.force.x() * along->y() - row.force.y() * along->x());
      }
      walls_.add(row);
    }
  }
  void add_overlaps(const StageView& now, const OverlapRecord& record) {
    const grains::State& state = now.model.state();
    const Overlaps overlaps = measure::overlap_contacts(state, now.model.grains().occupancy());
    add_pairs(now.scene, overlaps, record);
    add_bins(record.distribution(overlaps));
    std::vector<double> pushes(state.particles.size(), 0);
    for (const grains::Push& push : state.pushes) {
      ++pushes[push.pushed];
    }
    const std::vector<double> sites = measure::force_indices(state.particles.size(), overlaps);
    for (std::size_t id = 0; id < sites.size(); ++id) {
      if (sites[id] > 0) {
        loads_.add(load_row(now, id, pushes[id], sites[id]));
      }
    }
    const auto summary = measure::force_summary(state, now.model.grains().occupancy(), overlaps);
    for (const measure::WallOverlap& wall : summary.walls) {
      WallRow row = {wall};
      row.name = now.scene.walls[wall.wall].name;
      row.depth =
          measure::penetration_depth(state, state.walls[wall.wall], now.history.profile_at_start);
      walls_.add(row);
    }
  }
  void add_pairs(const scene::Scene& scene, const Overlaps& overlaps, const OverlapRecord& record) {
    std::map<std::pair<std::uint32_t, grains::Owner>, ContactRow> rows;
    const auto row_of = [&](std::uint32_t first, grains::Owner second) -> ContactRow& {
      ContactRow& row = rows[{first, second}];
      row.first = first;
      row.second = body_name(scene, second);
      return row;
    };
    for (const measure::OverlapContact& overlap : overlaps) {
      ContactRow& row = row_of(overlap.first, overlap.second);
      row.point = overlap.point;
      row.sites = overlap.shared_sites;
      row.depth = overlap.depth;
      row.source = overlap.source_wall ? scene.walls[*overlap.source_wall].name : "";
    }
    for (const measure::ForceAverage::Mean& mean : record.average().means()) {
      ContactRow& row = row_of(mean.first, mean.second);
      row.mean_sites = mean.shared_sites;
      row.share = mean.present_share;
    }
    for (const auto& [pair, row] : rows) {
      contacts_.add(row);
    }
  }
  void add_bins(const std::optional<measure::ForceDistribution>& distribution) {
    if (distribution) {
      for (const measure::ForceBin& bin : distribution->bins) {
        forces_.add(bin);
      }
    }
  }

  TableWriter<ContactRow> contacts_;
  TableWriter<measure::ForceBin> forces_;
  TableWriter<LoadRow> loads_;
  TableWriter<WallRow> walls_;
  std::optional<TableWriter<measure::StressCell>> stress_;
};

}  // namespace

ObserverFactory force_tables_observer() {
  return observer_factory<ForceTables>(
      [](const scene::Scene& scene) {
        return requests_measure(scene, scene::Measure::force) &&
               (is_contact_model(scene) || has_overlaps(scene));
      },
      {contacts_table, forces_table, loads_table, walls_table, stress_table});
}

}  // namespace clca::record
