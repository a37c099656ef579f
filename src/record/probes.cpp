// probes.csv: what the probes of the scene see.

#include <algorithm>
#include <iterator>

#include "clca/measure/field_grid.hpp"
#include "clca/scene/units.hpp"
#include "record/internal/observer.hpp"

namespace clca::record {

namespace {

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

/// Rows at the steps of series.csv. Motion: of the contact model, in that step; else since the last
/// row, of the particles that were in the probe then.
class Probes : public Observer {
 public:
  explicit Probes(const scene::Scene& scene) : table_(scene, probes_table(scene)) {}

  void begin_stage(const StageView& now) override { add_rows(now); }
  void after_step(const StageView& now) override {
    if (now.model.state().step % now.scene.output.series->every == 0) {
      add_rows(now);
    }
  }
  void end_stage(const StageView& now) override { add_rows(now); }
  void save(reflection::Columns& columns) override { reflection::encode(kPath, last_, columns); }
  void load(const SavedColumns& saved, const StageView& now) override {
    saved.read(kPath, last_, now.model.state());
  }
  std::vector<RunTable*> tables() override { return {&table_}; }

 private:
  static constexpr const char* kPath = "outputs/probes";

  /// One for each probe, unless the step has them.
  void add_rows(const StageView& now) {
    const grains::State& state = now.model.state();
    if (last_ && last_->step() == state.step) {
      return;
    }
    const double steps = last_ ? static_cast<double>(state.step - last_->step()) : 0;
    const double spacing_per_step = velocity_factor(now.scene);
    std::vector<measure::Displacement> displacements;
    if (is_contact_model(now.scene)) {
      displacements = measure::displacements_in_step(state, now.model.velocities());
    } else if (last_) {
      displacements = last_->displacements(state);
    }
    const std::vector<scene::Probe>& probes = now.scene.probes;
    std::vector<lattice::Rectangle> regions;
    std::ranges::transform(probes, std::back_inserter(regions),
                           [](const scene::Probe& probe) { return probe.region; });
    const std::vector<double> fillings = measure::filled_shares(state, regions);
    for (std::size_t i = 0; i < probes.size(); ++i) {
      ProbeRow row = {now, probes[i], fillings[i]};
      if (const auto motion = measure::region_motion(regions[i], displacements,
                                                     is_contact_model(now.scene) ? 1 : steps)) {
        row.particles = motion->particles;
        row.velocity = motion->velocity * spacing_per_step;
        row.fluctuation = motion->fluctuation * spacing_per_step * spacing_per_step;
      }
      if (last_) {
        row.flow = measure::sites_moved_down(*last_, state, regions[i]) / steps;
        if (scene::has_density(now.scene)) {
          row.mass_flow = scene::unit_conversion(now.scene)->mass_rate(*row.flow);
        }
      }
      table_.add(row);
    }
    last_.emplace(state);
  }

  std::optional<measure::Snapshot> last_;  // at the last row
  TableWriter<ProbeRow> table_;
};

}  // namespace

ObserverFactory probes_observer() {
  return observer_factory<Probes>(
      [](const scene::Scene& scene) { return scene.output.series && !scene.probes.empty(); },
      {probes_table});
}

}  // namespace clca::record
