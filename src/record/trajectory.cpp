// The trajectory of a run.

#include "clca/store/trajectory.hpp"

#include "record/internal/contact_record.hpp"

namespace clca::record {

namespace {

class TrajectoryObserver : public Observer {
 public:
  explicit TrajectoryObserver(const scene::Scene& scene) : scene_(scene) {}
  static double bytes(const scene::Scene& scene, double particles) {
    return store::TrajectoryWriter::bytes_for(scene, particles) +
           frame_bytes(scene, scene.output.trajectory->has_contacts, particles);
  }

  void begin_stage(const StageView& now) override { add(now, true); }
  void after_step(const StageView& now) override {
    if (now.history.steps % scene_.output.trajectory->every == 0) {
      add(now, false);
    }
  }
  void end_stage(const StageView& now) override { add(now, false); }
  void save(reflection::Columns& columns) override {
    writer_->flush();
    reflection::encode(kPath, writer_->written(), columns);
    reflection::encode(kStepPath, step_, columns);
  }
  void load(const SavedColumns& saved, const StageView& now) override {
    saved.read(kPath, kept_, now.model.state());
    saved.read(kStepPath, step_, now.model.state());
  }
  void open(const store::RunFolder& folder, const grains::State& now) override {
    writer_.emplace(folder.output_folder(), scene_, now, kept_);
  }
  void finish() override { writer_->flush(); }

 private:
  static constexpr const char* kPath = "outputs/trajectory";
  static constexpr const char* kStepPath = "outputs/trajectory_step";

  void add(const StageView& now, bool begins) {
    const grains::State& state = now.model.state();
    if (!begins && step_ == state.step) {
      return;
    }
    store::ContactFrame contact{.velocities = now.model.velocities(), .spins = now.model.spins()};
    if (scene_.output.trajectory->has_contacts) {
      contact.forces = now.observers.find<ContactRecord>()->shown_forces(now.model);
    }
    writer_->add_frame(state, static_cast<std::size_t>(&now.stage - scene_.stages.data()), begins,
                       contact);
    step_ = state.step;
  }

  const scene::Scene& scene_;
  store::TrajectoryWriter::Written kept_;
  std::optional<store::TrajectoryWriter> writer_;
  std::optional<std::uint64_t> step_;  // of the last frame
};

}  // namespace

ObserverFactory trajectory_observer() {
  return observer_factory<TrajectoryObserver>(
      [](const scene::Scene& scene) { return scene.output.trajectory.has_value(); });
}

}  // namespace clca::record
