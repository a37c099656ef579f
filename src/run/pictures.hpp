#pragma once
// Draws the frames that a scene requests.

#include "clca/reflection/reflection.hpp"
#include "clca/scene/scene.hpp"
#include "clca/store/run_folder.hpp"
#include "run/frame_painter.hpp"
#include "run/frame_writer.hpp"
#include "run/model.hpp"
#include "run/records.hpp"

namespace clca::run {

class Pictures {
 public:
  /// Throws SceneRunError if the driver cannot draw them.
  Pictures(const scene::Scene& scene, const grains::State& state, int threads);

  /// Sets what all pictures of the stage share; call after marking the origins.
  void begin_stage(const scene::Stage& stage, const grains::State& state);
  /// Captures the state; drawing and writing happen on another thread. A step is drawn once.
  void draw(const Model& model, const Records& records, const store::RunFolder& folder);
  /// Waits until all pictures are written.
  void finish() { writer_.finish(); }

  /// Part of a checkpoint, restored on resume.
  PictureHistory& history() { return history_; }

 private:
  const scene::Scene& scene_;
  FramePainter painter_;
  PictureHistory history_;
  FrameWriter writer_;  // last: at the end it waits for its thread, which uses the painter
};

}  // namespace clca::run
