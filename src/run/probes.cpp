// probes.csv: what the probes of a scene see.

#include <algorithm>
#include <iterator>

#include "clca/measure/probe.hpp"
#include "run/observer.hpp"

namespace clca::run {

namespace {

struct ProbeRow {
  const StageView& now;
  const scene::Probe& probe;
  double filling;
  std::optional<measure::RegionMotion> motion;
  std::optional<double> flow;
  double speed;  // unit of velocity
};

template <class Value>
std::optional<double> of_motion(const ProbeRow& row, Value value) {
  return row.motion ? std::optional<double>(value(*row.motion)) : std::nullopt;
}

const TableOf<ProbeRow>& probes_table() {
  using Motion = measure::RegionMotion;
  static const TableOf<ProbeRow> kTable(
      {.name = "probes"},
      {{kStep, [](auto& row) { return row.now.model.state().step; }},
       {kStage, [](auto& row) { return row.now.stage.name; }},
       {{"probe", "Probe", "", "its name"}, [](auto& row) { return row.probe.name; }},
       {{"filling", "Filling", "",
         "share of its sites that particles cover, of those without wall"},
        &ProbeRow::filling},
       {{"particles", "Particles", "particles", "that the next three are over"},
        [](auto& row) { return row.motion ? row.motion->particles : 0; }},
       {{"vx", "Velocity, x", "spacings/step", "their mean, weighted by sites"},
        [](auto& row) {
          return of_motion(row, [&](const Motion& in) { return in.velocity.x() * row.speed; });
        }},
       {{"vy", "Velocity, y", "spacings/step", "their mean, weighted by sites"},
        [](auto& row) {
          return of_motion(row, [&](const Motion& in) { return in.velocity.y() * row.speed; });
        }},
       {kFluctuation,
        [](auto& row) {
          return of_motion(
              row, [&](const Motion& in) { return in.fluctuation * row.speed * row.speed; });
        }},
       {{"flow", "Flow", "sites/step",
         "since the last row, of the particles whose centre has passed the horizontal middle line "
         "of the probe downwards, less those that have passed it upwards"},
        &ProbeRow::flow}});
  return kTable;
}

/// Rows at the steps of series.csv. Of the automaton, motion is over the steps since the last row,
/// of the particles that were in the probe then; of the contact model, it is that at the row.
class Probes : public Observer {
 public:
  explicit Probes(const scene::Scene& scene) : table_(scene, probes_table()) {}

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
    if (last_ && !last_->precedes(now.model.state())) {
      throw reflection::Mismatch("its probes are of another run");
    }
  }
  std::vector<RunTable*> tables() override { return {&table_}; }

 private:
  static constexpr const char* kPath = "outputs/probes";

  void add_rows(const StageView& now);

  std::optional<measure::Snapshot> last_;  // at the last row
  TableWriter<ProbeRow> table_;
};

void Probes::add_rows(const StageView& now) {
  const grains::State& state = now.model.state();
  if (last_ && last_->step() == state.step) {
    return;
  }
  const double steps = last_ ? static_cast<double>(state.step - last_->step()) : 0;
  std::vector<measure::Displacement> displacements;
  if (is_contact(now.scene)) {
    displacements = measure::displacements_in_step(state, now.model.velocities());
  } else if (last_) {
    displacements = last_->displacements(state);
  }
  const std::vector<scene::Probe>& probes = now.scene.probes;
  std::vector<lattice::Rectangle> regions;
  std::transform(probes.begin(), probes.end(), std::back_inserter(regions),
                 [](const scene::Probe& probe) { return probe.region; });
  const std::vector<double> fillings = measure::fillings(state, regions);
  for (std::size_t i = 0; i < probes.size(); ++i) {
    std::optional<double> flow;
    if (last_) {
      flow = measure::downward_flow(*last_, state, regions[i]) / steps;
    }
    table_.add({now, probes[i], fillings[i],
                measure::motion_in(regions[i], displacements, is_contact(now.scene) ? 1 : steps),
                flow, velocity_unit(now.scene)});
  }
  last_.emplace(state);
}

}  // namespace

ObserverKind probes_observer() {
  return observer_kind<Probes>(
      [](const scene::Scene& scene) { return !scene.probes.empty() && scene.output.series; },
      {&probes_table()});
}

}  // namespace clca::run
