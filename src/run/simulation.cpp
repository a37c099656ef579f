#include "clca/run/simulation.hpp"

#include <algorithm>
#include <exception>
#include <limits>
#include <stdexcept>
#include <type_traits>
#include <utility>

#include "clca/parallel/team.hpp"
#include "clca/run/setup.hpp"
#include "clca/scene/walls.hpp"
#include "drawing/internal/frame_painter.hpp"
#include "model/internal/scene_model.hpp"
#include "record/internal/quantities.hpp"
#include "run/stage.hpp"

namespace clca::run {

namespace {

scene::Scene checked(scene::Scene scene) {
  record::check_derived(scene);
  resolve_begin(scene, std::numeric_limits<double>::infinity());
  scene::check_room(scene);
  return scene;
}

scene::Scene without_files(scene::Scene scene) {
  scene.output.series.reset();
  scene.output.trajectory.reset();
  return scene;
}

}  // namespace

struct Simulation::Impl {
  Impl(const scene::Scene& wanted, int threads, std::function<void()> interrupt)
      : scene(checked(wanted)),
        options{.threads = parallel::start_team(threads)},
        interruption(std::move(interrupt)),
        model(std::make_shared<model::SceneModel>(scene, state_at_start(scene), options)),
        observed_scene(without_files(scene)),
        course{.scene = scene,
               .model = model.get(),
               .observers = record::Observers(record::make_observers(observed_scene))} {
    begin_stage();
  }

  bool is_last() const { return course.counters.stage + 1 == scene.stages.size(); }

  image::Image picture(const scene::PictureOutput& frames) {
    if (!scene_painter || *scene_painter->scene.output.frames != frames) {
      scene::Scene drawn = scene;
      drawn.output.frames = frames;
      scene_painter.emplace(std::move(drawn), model->state());
    }
    const drawing::CapturedFrame frame = scene_painter->painter.capture(
        drawing::current_content(scene_painter->scene, *model, course.observers), pictures);
    pictures.window.emplace(model->state());
    return scene_painter->painter.rasterize(frame).image;
  }

  struct ScenePainter {
    ScenePainter(scene::Scene drawn, const grains::State& state)
        : scene(std::move(drawn)), painter(scene, state, {}) {}

    scene::Scene scene;
    drawing::FramePainter painter;
  };

  /// Carries out a change; after one that has failed, state and records do not fit together.
  template <class Change>
  std::invoke_result_t<Change> guarded(Change change) {
    try {
      return change();
    } catch (...) {
      failure = std::current_exception();
      throw;
    }
  }

  grains::StepReport take_step() {
    if (end) {
      begin_next_stage();
    }
    const grains::StepReport report = course.step();
    end = stage_end(course.stage(), model->state(), course.history);
    if (end) {
      course.end_stage(*end);
    }
    return report;
  }

  void begin_next_stage() {
    ++course.counters.stage;
    course.counters.moving = course.counters.stepped = 0;
    end.reset();
    begin_stage();
  }

  void begin_stage() {
    if (model.use_count() > 1) {  // somebody holds the state
      model = std::make_shared<model::SceneModel>(scene, model->copied_state(), options);
    }
    model->set_interruption(interruption);
    course.model = model.get();
    course.history = prepare_stage(*model, scene, course.counters.stage);
    course.begin_stage();
    drawing::begin_stage(pictures, scene, course.stage(), model->state());
    pictures.window.emplace(model->state());
  }

  scene::Scene scene;
  grains::Options options;
  std::function<void()> interruption;
  std::shared_ptr<model::SceneModel> model;
  scene::Scene observed_scene;
  StageRunner course;
  std::optional<StageEnd> end;
  drawing::PictureHistory pictures;
  std::optional<ScenePainter> scene_painter;
  std::exception_ptr failure;
};

Simulation::Simulation(const scene::Scene& scene, int threads, std::function<void()> interruption)
    : impl_(std::make_unique<Impl>(scene, threads, std::move(interruption))) {}
Simulation::~Simulation() = default;

Simulation::Impl& Simulation::checked_impl() const {
  if (impl_->failure) {
    std::rethrow_exception(impl_->failure);
  }
  return *impl_;
}

const scene::Scene& Simulation::scene() const {
  return impl_->scene;
}
std::size_t Simulation::stage_index() const {
  return checked_impl().course.counters.stage;
}
std::string Simulation::stage_end_text() const {
  const Impl& impl = checked_impl();
  return impl.end ? to_text(*impl.end) : "";
}
bool Simulation::is_over() const {
  const Impl& impl = checked_impl();
  return impl.end && impl.is_last();
}
grains::StepReport Simulation::step() {
  if (is_over()) {
    throw std::logic_error("the last stage has ended");
  }
  return impl_->guarded([this] { return impl_->take_step(); });
}
void Simulation::begin_next_stage() {
  if (checked_impl().is_last()) {
    throw std::logic_error("the last stage has no next one");
  }
  impl_->guarded([this] { impl_->begin_next_stage(); });
}
const grains::State& Simulation::state() const {
  return checked_impl().model->state();
}
std::shared_ptr<const grains::State> Simulation::shared_state() const {
  const auto& model = checked_impl().model;
  const bool grows = std::ranges::any_of(model->state().sources, &grains::Source::open);
  return grows ? std::make_shared<const grains::State>(model->state())
               : std::shared_ptr<const grains::State>(model, &model->state());
}
store::ContactFrame Simulation::contact_frame() const {
  const model::SceneModel& model = *checked_impl().model;
  return {.velocities = model.velocities(), .spins = model.spins(), .forces = model.forces()};
}
std::uint64_t Simulation::state_hash() const {
  return checked_impl().model->hash();
}
std::vector<store::NamedMeasure> Simulation::measures(std::optional<scene::Measure> wanted) const {
  const record::StageView view = checked_impl().course.view();
  return wanted ? record::stage_measures(*wanted, view) : record::stage_measures(view);
}
image::Image Simulation::picture(const scene::PictureOutput& frames) {
  return checked_impl().picture(frames);
}

}  // namespace clca::run
