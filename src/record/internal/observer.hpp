#pragma once
// Observers of a run: each gathers what it needs and writes tables, pictures or a trajectory.

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "clca/grains/model.hpp"
#include "clca/measure/outflow.hpp"
#include "clca/record/quantity.hpp"
#include "clca/reflection/columns.hpp"
#include "clca/scene/scene.hpp"
#include "clca/store/run_folder.hpp"
#include "clca/store/summary.hpp"
#include "model/internal/scene_model.hpp"
#include "record/internal/table.hpp"

namespace clca::record {

/// What is known of a stage besides its final state.
struct StageHistory {
  StageHistory() = default;
  /// `state`: before the stage.
  StageHistory(const scene::Scene& scene, const grains::State& state);
  /// When the stage is prepared: its fill may be in outlets.
  void begin(const grains::State& state);
  /// After a step; cycles are counted elsewhere.
  void add_step(const grains::StepReport& report, const grains::State& state);

  std::vector<double> profile_at_start;  ///< measure::surface_profile
  std::size_t particles_at_start = 0;
  std::uint64_t steps = 0;
  std::uint64_t completed_cycles = 0;  ///< by all periodic walls and the vessel
  std::size_t emitted = 0;
  measure::Outflow outflow = {};
  std::vector<measure::Outflow> outlets = {};           ///< outflow of each outlet
  std::vector<std::uint64_t> discharged_at_start = {};  ///< measure::discharged_counts
  bool is_at_rest = false;                              ///< the last step was StepReport::settled
  bool ended_at_rest = false;                           ///< the stage ended settled, or stalled

  /// Share of the particles present or emitted during the stage that have left.
  double discharged_share() const;
  CLCA_FIELDS(profile_at_start, particles_at_start, steps, completed_cycles, emitted, outflow,
              outlets, discharged_at_start, is_at_rest);
};

class Observers;

/// A run at the begin or the end of a stage, or after a step.
struct StageView {
  const scene::Scene& scene;
  const scene::Stage& stage;
  const model::SceneModel& model;
  const StageHistory& history;
  const Observers& observers;
  std::size_t moving_particles;   ///< in the last step
  std::size_t stepped_particles;  ///< in the box in that step, also those removed at its end
  const store::OutputFolder* output_folder;  ///< null: nothing is written
  /// Prints a warning.
  std::function<void(const std::string& line)> warn;
};

/// The columns of a checkpoint.
struct SavedColumns {
  const reflection::Columns& columns;
  double max_bytes;

  /// Throws reflection::ColumnMismatch, also for what no run that reached `now` can have recorded.
  template <class T>
  void read(const std::string& path, T& value, const grains::State& now) const {
    reflection::decode(path, columns, max_bytes, value);
    bool fits = true;
    if constexpr (requires { value.precedes(now); }) {
      fits = value.precedes(now);
    } else if constexpr (requires { value->precedes(now); }) {
      fits = !value || value->precedes(now);
    }
    if (!fits) {
      throw reflection::ColumnMismatch(path + " is not of this run");
    }
  }
};

/// Observers are called in the order of their list, at each moment.
class Observer {
 public:
  Observer() = default;
  virtual ~Observer() = default;
  Observer(const Observer&) = delete;
  Observer& operator=(const Observer&) = delete;

  virtual void begin_stage(const StageView& /*now*/) {}
  virtual void after_step(const StageView& /*now*/) {}
  virtual void end_stage(const StageView& /*now*/) {}

  /// Saves what load() needs, with all that was written on the disk.
  virtual void save(reflection::Columns& /*columns*/) {}
  /// Goes on with a stage. Throws reflection::ColumnMismatch for what no run can have saved.
  virtual void load(const SavedColumns& /*saved*/, const StageView& /*now*/) {}

  /// Tables that it adds rows to; their rows are saved and loaded.
  virtual std::vector<RunTable*> tables() { return {}; }
  /// Before the first stage, or after load(): removes what was written later.
  virtual void open(const store::RunFolder& /*folder*/, const grains::State& /*now*/) {}
  /// Waits until everything is written.
  virtual void finish() {}
};

/// An observer that saves its fields at kPath. precedes(state), if it has that, is false for what
/// no run that reached the state can have recorded.
template <class T>
class SavedObserver : public Observer {
 public:
  void begin_stage(const StageView& now) override { prepare(now); }
  void save(reflection::Columns& columns) override {
    reflection::encode(T::kPath, static_cast<const T&>(*this), columns);
  }
  void load(const SavedColumns& saved, const StageView& now) override {
    prepare(now);
    saved.read(T::kPath, static_cast<T&>(*this), now.model.state());
  }

 protected:
  /// Prepares for a stage that begins or goes on.
  virtual void prepare(const StageView& now) = 0;
};

class Observers {
 public:
  explicit Observers(std::vector<std::unique_ptr<Observer>> all);

  /// The observer of a type; null if the scene has none.
  template <class T>
  const T* find() const {
    for (const auto& observer : all_) {
      if (const auto* found = dynamic_cast<const T*>(observer.get())) {
        return found;
      }
    }
    return nullptr;
  }

  std::vector<store::TableSummary> table_summaries() const;
  void open(const store::RunFolder& folder, const grains::State& now);
  void begin_stage(const StageView& now) { call(&Observer::begin_stage, now); }
  void after_step(const StageView& now);
  void end_stage(const StageView& now);
  void save(reflection::Columns& columns);
  void load(const SavedColumns& saved, const StageView& now);
  void finish() { call(&Observer::finish); }

 private:
  template <class... Parameters, class... Arguments>
  void call(void (Observer::*function)(Parameters...), Arguments&... arguments) {
    for (const auto& observer : all_) {
      (observer.get()->*function)(arguments...);
    }
  }
  void write_rows(std::size_t least);

  std::vector<std::unique_ptr<Observer>> all_;
  std::vector<RunTable*> tables_;
};

using MeasureValues = std::vector<store::MeasureValue>;

/// Quantities that are taken together at the end of a stage.
struct QuantityGroup {
  std::optional<scene::Measure> measure;  ///< that requests them; none: always taken
  std::string_view condition;             ///< Markdown: when there are values; empty: always
  std::vector<Quantity> quantities;
  /// In the order of the quantities; none where the condition does not hold.
  MeasureValues (*values)(const StageView& stage);
  /// Some of the values of each outlet or species, named; may be null.
  std::vector<store::NamedMeasure> (*values_of_each)(const StageView& stage) = nullptr;
};

struct ObserverFactory {
  /// Null if the scene does not need it.
  std::function<std::unique_ptr<Observer>(const scene::Scene& scene)> make;
  /// Its tables for a scene.
  std::vector<std::function<TableInfo(const scene::Scene&)>> tables = {};
  std::vector<QuantityGroup> quantities = {};
  /// Memory that it takes at most, with its share of a checkpoint; null: nothing that counts.
  std::function<double(const scene::Scene& scene, double particles)> bytes = {};
};

/// Kind of an observer made of the scene alone, if it is `wanted`; it may have a function `bytes`.
template <class T>
ObserverFactory observer_factory(
    bool (*wanted)(const scene::Scene& scene),
    std::vector<std::function<TableInfo(const scene::Scene&)>> tables = {},
    std::vector<QuantityGroup> quantities = {}) {
  ObserverFactory kind = {[wanted](const scene::Scene& scene) -> std::unique_ptr<Observer> {
                            return wanted(scene) ? std::make_unique<T>(scene) : nullptr;
                          },
                          std::move(tables), std::move(quantities)};
  if constexpr (requires(const scene::Scene& scene) { T::bytes(scene, 0.0); }) {
    kind.bytes = [wanted](const scene::Scene& scene, double particles) {
      return wanted(scene) ? T::bytes(scene, particles) : 0;
    };
  }
  return kind;
}

/// Kinds of all observers but pictures, in the order in which they observe.
const std::vector<ObserverFactory>& observer_factories();

/// The observers that the scene needs.
std::vector<std::unique_ptr<Observer>> make_observers(const scene::Scene& scene);
/// Memory that these observers take at most, with their share of a checkpoint.
double observer_bytes(const scene::Scene& scene, double particles);

bool requests_measure(const scene::Scene& scene, scene::Measure measure);

}  // namespace clca::record
