#pragma once
// Draws the frames that a scene asks for.

#include "clca/fields/fields.hpp"
#include "clca/scene/scene.hpp"
#include "clca/store/run_folder.hpp"
#include "run/frame_painter.hpp"
#include "run/frame_writer.hpp"
#include "run/model.hpp"
#include "run/records.hpp"

namespace clca::run {

class Pictures {
 public:
  /// Throws ScenePlaceError when the driver cannot draw what the scene asks for.
  Pictures(const scene::Scene& scene, const grains::State& state, int threads);

  /// Sets what the stage's pictures have in common; call when the origins are marked.
  void begin_stage(const scene::Stage& stage, const grains::State& state);
  /// Takes what the picture needs of the state; drawing and writing it is for another thread. A
  /// step is drawn once.
  void draw(const Model& model, const Records& records, const store::RunFolder& folder);
  /// Waits until all pictures are written.
  void finish() { writer_.finish(); }

  /// What a checkpoint keeps, and a run that goes on puts back.
  PictureHistory& history() { return history_; }

 private:
  const scene::Scene& scene_;
  FramePainter painter_;
  PictureHistory history_;
  FrameWriter writer_;  // last: at the end it waits for its thread, which uses the painter
};

}  // namespace clca::run
