// The pictures of a run while it is under way.

#include <fmt/format.h>

#include "clca/measure/weight_paths.hpp"
#include "clca/tasks/background.hpp"
#include "drawing/internal/frame_painter.hpp"
#include "record/internal/contact_record.hpp"

namespace clca::drawing {

namespace {

class Pictures : public record::Observer {
 public:
  /// Throws scene::SceneError if the driver cannot draw them.
  Pictures(const scene::Scene& scene, const grains::State& state, int threads, bool only_last)
      : scene_(scene), only_last_(only_last), painter_(scene, state, {.threads = threads}) {}

  void begin_stage(const record::StageView& now) override {
    drawing::begin_stage(history_, scene_, now.stage, now.model.state());
    if (!only_last_) {
      draw(now);
    }
  }
  void after_step(const record::StageView& now) override {
    if (!only_last_ && now.history.steps % scene_.output.frames->every == 0) {
      draw(now);
    }
  }
  void end_stage(const record::StageView& now) override {
    if (!only_last_ || &now.stage == &scene_.stages.back()) {
      draw(now);
    }
  }
  void save(reflection::Columns& columns) override {
    finish();
    reflection::encode(kPath, history_, columns);
  }
  void load(const record::SavedColumns& saved, const record::StageView& now) override {
    saved.read(kPath, history_, now.model.state());
    if (scene::pictures_compare_positions(scene_) != history_.window.has_value() ||
        (history_.window && !history_.window->precedes(now.model.state()))) {
      throw reflection::ColumnMismatch("its velocities are of another run");
    }
    if (!history_.stage.empty() && history_.stage != now.stage.name) {
      throw reflection::ColumnMismatch("its pictures are of another stage");
    }
  }
  void open(const store::RunFolder& folder, const grains::State& /*now*/) override {
    folder.remove_frames_after(history_.last_step);
    folder.output_folder().make_folder(store::kFramesFolder);
  }
  void finish() override { writer_.finish(); }

 private:
  static constexpr const char* kPath = "outputs/pictures";

  /// Captures the state; drawing and writing happen on another thread. A step is drawn once.
  void draw(const record::StageView& now) {
    const grains::State& state = now.model.state();
    if (history_.last_step == state.step) {
      return;
    }
    history_.last_step = state.step;
    CapturedFrame frame =
        painter_.capture(current_content(scene_, now.model, now.observers), history_);
    begin_window(history_, scene_, state);
    writer_.start([this, folder = now.output_folder->subfolder(store::kFramesFolder),
                   name = store::frame_name(scene_.name, state.step, scene::step_digits(scene_)),
                   frame = std::move(frame)] {
      const Picture picture = painter_.rasterize(frame);
      folder.write(name, image::encode_png(picture.image, picture.text));
    });
  }

  const scene::Scene& scene_;
  bool only_last_;
  FramePainter painter_;
  PictureHistory history_;
  tasks::BackgroundCall
      writer_;  // last: at the end it waits for its thread, which uses the painter
};

}  // namespace

std::unique_ptr<record::Observer> pictures_observer(const scene::Scene& scene,
                                                    const grains::State& state, int threads,
                                                    bool only_last) {
  return std::make_unique<Pictures>(scene, state, threads, only_last);
}

double picture_memory_bytes(const scene::Scene& scene, double particles) {
  if (!scene.output.frames) {
    return 0;
  }
  constexpr int kCaptures = 2;  // one on its way and a new one
  const bool has_forces = scene::pictures_show_forces(scene);
  const bool has_paths = scene::shows_weight_paths(scene.output.frames->overlay);
  const double lines = has_paths    ? measure::kSupportsPerGrain
                       : has_forces ? contact::kContactsPerGrain
                                    : 0;
  const double strokes = kCaptures * lines * sizeof(render::Stroke);
  const double paths =
      has_paths ? measure::weight_paths_bytes(particles) +
                      grains::kListCapacityRatio * lines * particles * sizeof(render::ForceLine)
                : 0;
  const double window =
      scene::pictures_compare_positions(scene)
          ? 2 * measure::Snapshot::bytes_for(particles) + particles * sizeof(measure::Displacement)
          : 0;
  return FramePainter::bytes_for(scene, particles, kCaptures) + window + paths +
         particles * strokes + record::frame_bytes(scene, has_forces, particles);
}

}  // namespace clca::drawing
