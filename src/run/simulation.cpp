#include "clca/run/simulation.hpp"

#include <algorithm>
#include <exception>
#include <functional>
#include <limits>
#include <stdexcept>
#include <type_traits>
#include <utility>

#include "clca/parallel/team.hpp"
#include "clca/run/setup.hpp"
#include "clca/scene/walls.hpp"
#include "drawing/internal/frame_painter.hpp"
#include "model/internal/scene_model.hpp"
#include "record/internal/contact_record.hpp"
#include "record/internal/cycle_record.hpp"
#include "record/internal/quantities.hpp"
#include "run/stage.hpp"

namespace clca::run {

namespace {

scene::Scene checked(scene::Scene scene) {
  record::check_derived(scene);
  find_begin(scene, std::numeric_limits<double>::infinity());
  scene::check_room(scene);
  return scene;
}

/// Without what is only written to files.
scene::Scene without_files(scene::Scene scene) {
  scene.output.series.reset();
  scene.output.trajectory.reset();
  return scene;
}

}  // namespace

class Simulation::Impl {
 public:
  Impl(const scene::Scene& scene, int threads, std::function<void()> interruption)
      : scene_(checked(scene)),
        options_{.threads = parallel::start_team(threads)},
        interruption_(std::move(interruption)),
        model_(std::make_shared<model::SceneModel>(scene_, first_state(scene_), options_)),
        observed_(without_files(scene_)),
        observers_(record::observers_of(observed_)) {
    begin_stage();
  }

  const scene::Scene& scene() const { return scene_; }
  std::size_t stage_number() const { return stage_; }
  const std::optional<StageEnd>& end() const { return end_; }
  bool is_last() const { return stage_ + 1 == scene_.stages.size(); }
  const model::SceneModel& model() const { return *model_; }

  /// Rethrows what has failed.
  void check() const {
    if (failure_) {
      std::rethrow_exception(failure_);
    }
  }

  grains::StepReport step() {
    if (end_ && is_last()) {
      throw std::logic_error("the last stage has ended");
    }
    return whole([&] { return take_step(); });
  }

  void next_stage() {
    if (is_last()) {
      throw std::logic_error("the last stage has no next one");
    }
    whole([&] { begin_next_stage(); });
  }

  std::shared_ptr<const grains::State> held_grains() const {
    const auto& sources = model_->state().sources;
    const bool grows = std::any_of(sources.begin(), sources.end(),
                                   [](const grains::Source& source) { return source.open; });
    return grows ? std::make_shared<const grains::State>(model_->state())
                 : std::shared_ptr<const grains::State>(model_, &model_->state());
  }

  std::vector<store::NamedMeasure> measures(std::optional<scene::Measure> wanted) const {
    return wanted ? record::stage_measures(*wanted, view()) : record::stage_measures(view());
  }

  image::Image picture(const scene::Frames& frames) {
    if (!drawing_ || *drawing_->scene.output.frames != frames) {
      scene::Scene drawn = scene_;
      drawn.output.frames = frames;
      drawing_.emplace(std::move(drawn), model_->state());
    }
    const drawing::CapturedFrame frame = drawing_->painter.capture(
        {.state = model_->state(),
         .occupancy = model_->grains().occupancy(),
         .cycles = observers_.find<record::CycleRecord>(),
         .contact = record::shown_contact(drawing_->scene, *model_, observers_),
         .angle = model_->vessel().angle},
        pictures_);
    pictures_.window.emplace(model_->state());
    return drawing_->painter.rasterize(frame).image;
  }

 private:
  /// Draws pictures that look the same way.
  struct Drawing {
    Drawing(scene::Scene drawn, const grains::State& state)
        : scene(std::move(drawn)), painter(scene, state, {}) {}

    scene::Scene scene;
    drawing::FramePainter painter;
  };

  const scene::Stage& stage() const { return scene_.stages[stage_]; }
  record::StageView view() const {
    return {scene_,   stage(),    *model_,
            history_, observers_, moving_,
            stepped_, nullptr,    [](const auto& /*line*/) {}};
  }

  /// Carries out a change; after one that has failed, state and records do not fit together.
  template <class Change>
  std::invoke_result_t<Change> whole(Change change) {
    try {
      return change();
    } catch (...) {
      failure_ = std::current_exception();
      throw;
    }
  }

  grains::StepReport take_step() {
    if (end_) {
      begin_next_stage();
    }
    const grains::StepReport report = model_->grains().step();
    history_.add_step(report, model_->state());
    moving_ = report.moved;
    stepped_ = grains::present_count(model_->state()) + report.removed;
    observers_.after_step(view());
    history_.cycles = observers_.find<record::CycleRecord>()->cycles();
    end_ = stage_end(stage(), model_->state(), history_);
    if (end_) {
      history_.settled = end_ == StageEnd::settled || end_ == StageEnd::stalled;
      observers_.end_stage(view());
    }
    return report;
  }

  void begin_next_stage() {
    ++stage_;
    end_.reset();
    begin_stage();
  }

  void begin_stage() {
    if (model_.use_count() > 1) {  // somebody holds the state
      model_ = std::make_shared<model::SceneModel>(scene_, model_->copied_state(), options_);
    }
    history_ = stage_ > 0
                   ? record::StageHistory(scene_, model_->state())
                   : record::StageHistory(scene_, model::grains_of(model::empty_state(scene_)));
    model_->grains().set_interruption(interruption_);
    prepare_stage(*model_, scene_, stage());
    history_.begin(model_->state());
    moving_ = 0;
    stepped_ = 0;
    observers_.begin_stage(view());
    drawing::begin_stage(pictures_, scene_, stage(), model_->state());
    pictures_.window.emplace(model_->state());
  }

  scene::Scene scene_;
  grains::Options options_;
  std::function<void()> interruption_;
  std::shared_ptr<model::SceneModel> model_;
  scene::Scene observed_;
  record::Observers observers_;
  record::StageHistory history_;
  std::size_t moving_ = 0;  // particles, in the last step
  std::size_t stepped_ = 0;
  std::size_t stage_ = 0;
  std::optional<StageEnd> end_;
  drawing::PictureHistory pictures_;
  std::optional<Drawing> drawing_;
  std::exception_ptr failure_;
};

Simulation::Simulation(const scene::Scene& scene, int threads, std::function<void()> interruption)
    : impl_(std::make_unique<Impl>(scene, threads, std::move(interruption))) {}
Simulation::~Simulation() = default;

Simulation::Impl& Simulation::live() const {
  impl_->check();
  return *impl_;
}

const scene::Scene& Simulation::scene() const {
  return impl_->scene();
}
std::size_t Simulation::stage() const {
  return live().stage_number();
}
std::string Simulation::ended() const {
  const Impl& impl = live();
  return impl.end() ? to_text(*impl.end()) : "";
}
bool Simulation::is_over() const {
  const Impl& impl = live();
  return impl.end() && impl.is_last();
}
grains::StepReport Simulation::step() {
  return live().step();
}
void Simulation::next_stage() {
  live().next_stage();
}
const grains::State& Simulation::grains() const {
  return live().model().state();
}
std::shared_ptr<const grains::State> Simulation::held_grains() const {
  return live().held_grains();
}
store::ContactFrame Simulation::contact_frame() const {
  const model::SceneModel& model = live().model();
  return {.velocities = model.velocities(),
          .spins = model.spins(),
          .forces = model.forces().value_or(std::vector<contact::Force>())};
}
std::uint64_t Simulation::hash() const {
  return live().model().hash();
}
std::vector<store::NamedMeasure> Simulation::measures(std::optional<scene::Measure> wanted) const {
  return live().measures(wanted);
}
image::Image Simulation::picture(const scene::Frames& frames) {
  return live().picture(frames);
}

}  // namespace clca::run
