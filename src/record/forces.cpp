// Forces between grains, and of walls that push grains and are stalled: measures, and tables of
// contacts at the end of a stage. Tables of the contact model are in weights of a grain of mean
// mass, those with walls that overlap particles in sites.

#include "record/internal/forces.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <optional>
#include <vector>

#include "clca/contact/force.hpp"
#include "clca/measure/field_grid.hpp"
#include "clca/measure/force.hpp"
#include "record/internal/contact_record.hpp"
#include "record/internal/cycle_record.hpp"
#include "record/internal/quantities.hpp"

namespace clca::record {

namespace {

using Forces = std::vector<contact::Force>;
using Overlaps = std::vector<measure::OverlapContact>;

/// True if some wall of the scene moves and may overlap particles.
bool has_overlaps(const scene::Scene& scene) {
  return std::ranges::any_of(scene.walls, [](const scene::Wall& wall) {
    return wall.motion && wall.passive == grains::Passive::overlap;
  });
}

/// Overlaps of a stage, averaged over steps.
class ForceRecord : public SavedObserver<ForceRecord> {
 public:
  /// With scene::Output::contacts, contacts are averaged over time.
  explicit ForceRecord(const scene::Scene& scene) : sampling_(scene.output.contacts) {}

  void after_step(const StageView& now) override {
    if (sampling_ && now.history.steps % sampling_->every == 0) {
      average_.add(measure::contacts(now.model.state(), now.model.grains().occupancy()));
    }
  }

  /// Distribution of the averages if contacts are sampled, else of the present overlaps.
  std::optional<measure::ForceDistribution> distribution(const Overlaps& contacts) const {
    if (sampling_) {
      return measure::force_distribution(measure::strengths(average_.means()),
                                         measure::Strength::averaged);
    }
    return measure::force_distribution(measure::strengths(contacts),
                                       measure::Strength::whole_sites);
  }
  const measure::ForceAverage& average() const { return average_; }

  bool precedes(const grains::State& now) const { return average_.precedes(now); }
  static constexpr const char* kPath = "records/forces";
  CLCA_FIELDS(average_);

 private:
  void prepare(const StageView& /*now*/) override { average_ = {}; }

  std::optional<scene::Contacts> sampling_;
  measure::ForceAverage average_;
};

/// Of the normal forces between grains; none without any.
std::optional<measure::ForceDistribution> distribution(const Forces& forces) {
  std::vector<double> strengths;
  for (const contact::Force& force : forces) {
    if (grains::is_particle(force.other) && force.along_normal > 0) {
      strengths.push_back(force.along_normal);
    }
  }
  return measure::force_distribution(strengths, measure::Strength::averaged);
}

using Values = std::vector<store::MeasureValue>;

/// Whether a wall is stalled: it is due to move and blocked.
bool is_stalled(const grains::Wall& wall) {
  return wall.present && wall.travel.active && wall.travel.stalled_since &&
         !grains::is_over(*wall.motion, wall.travel);
}

constexpr Quantity kShareAboveMean = {"force_share_above_mean", "Contacts above the mean force", "",
                                      "their share"};
constexpr Quantity kTailBeta = {"force_tail_beta", "Tail of the forces, β", "",
                                "of exp(-β f/⟨f⟩), which the forces above the mean f follow"};

Values values_of(const std::optional<measure::ForceDistribution>& distribution) {
  return distribution
             ? Values{distribution->share_above_mean, store::value_or_null(distribution->beta)}
             : Values(2);
}

/// Of grains that touch.
Values contact_forces(const StageView& stage) {
  const auto* contacts = stage.observers.find<ContactRecord>();
  if (contacts == nullptr) {
    return {};
  }
  const std::vector<contact::Force> forces = contacts->at_end(stage.model);
  const grains::State& state = stage.model.state();
  const auto grains = static_cast<double>(grains::present_count(state));
  double touching = 0;  // bodies of contacts that are grains
  double floor = 0;
  for (const contact::Force& force : forces) {
    touching += grains::is_particle(force.other) ? 2 : 1;
    floor += force.other == contact::kFloor ? force.on_upper().y() : 0;
  }
  const std::vector<double> residuals =
      contact::residuals(state, forces, gravity_direction(stage.model.vessel()));
  const double residual = std::accumulate(residuals.begin(), residuals.end(), 0.0);
  const auto per_grain = [&](double sum) {
    return grains > 0 ? store::MeasureValue(sum / grains) : store::MeasureValue();
  };
  const Values shape = values_of(distribution(forces));
  return {per_grain(touching), shape[0], shape[1], per_grain(residual), per_grain(floor)};
}

/// Of walls that overlap grains.
Values overlap_forces(const StageView& stage) {
  const auto* overlaps = stage.observers.find<ForceRecord>();
  if (overlaps == nullptr) {
    return {};
  }
  const grains::State& state = stage.model.state();
  const grains::Occupancy& occupancy = stage.model.grains().occupancy();
  const auto contacts = measure::contacts(state, occupancy);
  const auto summary = measure::force_summary(state, occupancy, contacts);
  const Values shape = values_of(overlaps->distribution(contacts));
  std::optional<double> depth;          // of the deepest wall
  std::optional<double> stalled_since;  // of the first to stall
  for (const measure::WallOverlap& overlap : summary.walls) {
    const grains::Wall& wall = state.walls[overlap.wall];
    const auto of_wall = measure::penetration(state, wall, stage.history.profile_at_start);
    if (of_wall && wall.lets_overlap()) {
      depth = std::max(depth.value_or(*of_wall), *of_wall);
    }
    if (is_stalled(wall)) {
      const auto step = static_cast<double>(*overlap.stalled_since);
      stalled_since = std::min(stalled_since.value_or(step), step);
    }
  }
  return {static_cast<double>(summary.depth_max),
          static_cast<double>(summary.sites),
          static_cast<double>(summary.contacts),
          store::value_or_null(summary.cone_share),
          static_cast<double>(summary.jammed),
          shape[0],
          shape[1],
          store::value_or_null(depth),
          store::value_or_null(stalled_since)};
}

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
        is_contact(scene),
        {{{"normal_", "Normal", "", "towards the first"},
          [](auto& row) { return row.force->normal; }},
         {{"normal_force", "Normal force", scene::kContactForceUnit, ""},
          [](auto& row) { return row.force->along_normal; }},
         {{"shear_force", "Shear force", scene::kContactForceUnit,
           "along the normal turned anticlockwise"},
          [](auto& row) { return row.force->along_shear; }}}},
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
  const std::string_view unit = is_contact(scene) ? scene::kContactForceUnit : "sites";
  return {
      {.name = "forces", .kind = TableInfo::Kind::parts},
      {{{"low", "Lower end of the bin", unit,
         "of the index of force; of the contact model of normal forces between grains, in grain "
         "weights"},
        &Bin::low},
       {{"high", "Upper end of the bin", unit, "likewise"}, &Bin::high},
       {{"count", "Contacts", "", "in the bin"}, &Bin::count},
       {{"density", "Probability density", "", "of f/⟨f⟩"}, &Bin::density}}};
}

struct LoadRow {
  std::uint64_t id;
  std::string species;
  Eigen::Vector2d centre;
  std::uint64_t contacts = 0;
  double load = 0;  ///< sum of normal forces, or of sites
  double residual = 0;
};

TableOf<LoadRow> loads_table(const scene::Scene& scene) {
  return {{.name = "loads", .kind = TableInfo::Kind::parts},
          {{{"id", "Particle", "", "its number; with `passive: overlap` of those that overlap"},
            &LoadRow::id},
           {{"species", "Species", "", "its name"}, &LoadRow::species},
           {{"", "Position", "spacings", "of the centre of mass"}, &LoadRow::centre}},
          {{kContactModel,
            is_contact(scene),
            {{{"contacts", "Contacts", "", ""}, &LoadRow::contacts},
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
  std::uint64_t contacts = 0;
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
        is_contact(scene),
        {{{"contacts", "Contacts", "", ""}, &WallRow::contacts},
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
          &WallRow::particles},
         {{"sites", "Overlap", "sites", "of the wall with particles"}, &WallRow::sites},
         {{"chain_sites", "Overlap in chains", "sites", "in all contacts that began at it"},
          &WallRow::chain_sites},
         {{"jammed", "Jammed", "particles", "pushed from this wall and at rest"},
          &WallRow::jammed}}}}};
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

/// Of a particle, without its load.
LoadRow load_row(const StageView& now, std::size_t id) {
  const grains::State& state = now.model.state();
  const grains::Particle& particle = state.particles[id];
  return {.id = id,
          .species = now.scene.species[state.kinds[particle.kind].species].name,
          .centre = grains::centre_in_box(state, particle)};
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

/// A unit vector along a wall whose parts are all parallel, or a side of the box: towards its lower
/// end, or to the right. None for other walls.
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
    if (is_contact(scene)) {
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
      table->set_mean_mass(contact::mean_mass(now.model.state()));
    }
    if (const auto* contacts = now.observers.find<ContactRecord>()) {
      add_forces(now, contacts->at_end(now.model));
    } else {
      add_overlaps(now, *now.observers.find<ForceRecord>());
    }
    for (RunTable* table : tables()) {
      table->write(now.files, now.stage.name);
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
    add_bins(distribution(forces));
    add_loads(now, forces);
    add_walls(now.scene, forces);
    const double cell = now.observers.find<CycleRecord>()->cell();
    for (const measure::StressCell& stress :
         measure::stress_field(now.model.state(), forces, cell)) {
      if (stress.xx != 0 || stress.xy != 0 || stress.yy != 0) {
        stress_->add(stress);
      }
    }
  }
  void add_loads(const StageView& now, const Forces& forces) {
    const grains::State& state = now.model.state();
    struct Load {
      std::uint64_t contacts = 0;
      double normal = 0;
    };
    std::vector<Load> loads(state.particles.size());
    const auto add = [&](std::size_t id, const contact::Force& force) {
      ++loads[id].contacts;
      loads[id].normal += force.along_normal;
    };
    for (const contact::Force& force : forces) {
      add(force.upper, force);
      if (grains::is_particle(force.other)) {
        add(static_cast<std::size_t>(force.other), force);
      }
    }
    const std::vector<double> residuals =
        contact::residuals(state, forces, gravity_direction(now.model.vessel()));
    for (std::size_t id = 0; id < loads.size(); ++id) {
      if (state.particles[id].present) {
        LoadRow row = load_row(now, id);
        row.contacts = loads[id].contacts;
        row.load = loads[id].normal;
        row.residual = residuals[id];
        loads_.add(row);
      }
    }
  }
  void add_walls(const scene::Scene& scene, const Forces& forces) {
    std::map<grains::Owner, WallRow> rows;
    for (const grains::Owner body : walls_and_sides(scene)) {
      rows[body] = {};
    }
    for (const contact::Force& force : forces) {
      if (!grains::is_particle(force.other)) {
        WallRow& row = rows[force.other];
        ++row.contacts;
        row.force -= force.on_upper();
      }
    }
    for (auto& [owner, row] : rows) {
      row.name = body_name(scene, owner);
      if (const auto along = direction_of(scene, owner)) {
        row.along = row.force.dot(*along);
        row.across = std::abs(row.force.x() * along->y() - row.force.y() * along->x());
      }
      walls_.add(row);
    }
  }
  void add_overlaps(const StageView& now, const ForceRecord& record) {
    const grains::State& state = now.model.state();
    const Overlaps overlaps = measure::contacts(state, now.model.grains().occupancy());
    add_pairs(now.scene, overlaps, record);
    add_bins(record.distribution(overlaps));
    std::vector<std::uint64_t> pushes(state.particles.size(), 0);
    for (const grains::Push& push : state.pushes) {
      ++pushes[push.pushed];
    }
    const std::vector<double> sites = measure::force_indices(state.particles.size(), overlaps);
    for (std::size_t id = 0; id < sites.size(); ++id) {
      if (sites[id] > 0) {
        LoadRow row = load_row(now, id);
        row.contacts = pushes[id];
        row.load = sites[id];
        loads_.add(row);
      }
    }
    const auto summary = measure::force_summary(state, now.model.grains().occupancy(), overlaps);
    for (const measure::WallOverlap& wall : summary.walls) {
      WallRow row = {wall};
      row.name = now.scene.walls[wall.wall].name;
      row.depth = measure::penetration(state, state.walls[wall.wall], now.history.profile_at_start);
      walls_.add(row);
    }
  }
  void add_pairs(const scene::Scene& scene, const Overlaps& overlaps, const ForceRecord& record) {
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
      row.sites = overlap.sites;
      row.depth = overlap.depth;
      row.source = overlap.source ? scene.walls[*overlap.source].name : "";
    }
    for (const measure::ForceAverage::Mean& mean : record.average().means()) {
      ContactRow& row = row_of(mean.first, mean.second);
      row.mean_sites = mean.sites;
      row.share = mean.share;
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

ObserverKind overlaps_observer() {
  return observer_kind<ForceRecord>(has_overlaps);
}

std::vector<QuantityGroup> force_quantities() {
  using scene::Measure;
  return {
      {Measure::force,
       "model `contact`",
       {{"contacts_per_grain", "Contacts of a grain", "", "with grains and walls, mean"},
        kShareAboveMean,
        kTailBeta,
        {"balance_residual", "Balance of forces", "",
         "what forces and weight do not balance, over the weight; mean over grains"},
        {"load_floor", "Load on the floor", "",
         "force on the floor of the box over the weight of all grains", true}},
       contact_forces},
      {Measure::force,
       "with a plate or piston",
       {{"overlap_depth_max", "Deepest overlap", "moves",
         "moves that the deepest overlap would take back"},
        {"overlap_sites", "Overlap", "sites", "shared by all pairs that overlap"},
        {"overlap_contacts", "Pairs that overlap", "", ""},
        {"overlap_cone_share", "Overlap in the cone", "",
         "share of the sites within 45° ahead of the wall that pushed"},
        {"jammed", "Jammed", "particles", "pushed and at rest"},
        kShareAboveMean,
        kTailBeta,
        {"plate_depth", "Depth of the plate", "spacings",
         "of the deepest plate under the surface at the start of the stage"},
        {"stalled_since", "Stalled since", "step", "since when a wall wants to go on and cannot"}},
       overlap_forces}};
}

std::vector<std::string> stall_lines(const scene::Scene& scene, const model::SceneModel& model,
                                     const std::vector<double>& surface_at_start) {
  const grains::State& state = model.state();
  const auto contacts = measure::contacts(state, model.grains().occupancy());
  std::vector<std::string> lines;
  for (const measure::WallOverlap& overlap :
       measure::force_summary(state, model.grains().occupancy(), contacts).walls) {
    const grains::Wall& wall = state.walls[overlap.wall];
    if (!is_stalled(wall)) {
      continue;
    }
    std::string line =
        fmt::format("wall {} stalls since step {} after {} sites", scene.walls[overlap.wall].name,
                    *overlap.stalled_since, overlap.travel);
    if (wall.lets_overlap()) {
      const auto depth = measure::penetration(state, wall, surface_at_start);
      line += depth && *depth > 0 ? fmt::format(", {:.1f} spacings deep", *depth) : "";
      line += fmt::format(": {} sites overlap, {} particles are jammed", overlap.chain_sites,
                          overlap.jammed);
    }
    lines.push_back(line);
  }
  return lines;
}

ObserverKind force_tables_observer() {
  return observer_kind<ForceTables>(
      [](const scene::Scene& scene) {
        return requests(scene, scene::Measure::force) && (is_contact(scene) || has_overlaps(scene));
      },
      {contacts_table, forces_table, loads_table, walls_table, stress_table});
}

}  // namespace clca::record
