#pragma once
// Draws the frames that a scene asks for.

#include <string>

#include "clca/automaton/automaton.hpp"
#include "clca/fields/fields.hpp"
#include "clca/scene/scene.hpp"
#include "clca/store/run_folder.hpp"
#include "run/frame_painter.hpp"
#include "run/frame_writer.hpp"
#include "run/records.hpp"

namespace clca::run {

class Pictures {
 public:
  /// Throws ScenePlaceError when the driver cannot draw what the scene asks for.
  Pictures(const scene::Scene& scene, const automaton::State& state);

  /// Sets what the stage's pictures have in common; call when the origins are marked.
  void begin_stage(const std::string& stage, const automaton::State& state);
  /// Draws the state and hands the picture over to be written. A step is drawn once.
  void draw(const automaton::Automaton& automaton, const Records& records,
            const store::RunFolder& folder);
  /// Waits until all pictures are written.
  void finish() { writer_.finish(); }

  /// What a checkpoint keeps, and a run that goes on puts back.
  PictureHistory& history() { return history_; }

 private:
  const scene::Scene& scene_;
  FramePainter painter_;
  FrameWriter writer_;
  PictureHistory history_;
};

}  // namespace clca::run
