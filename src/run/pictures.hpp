#pragma once
// Draws the frames that a scene asks for.

#include <memory>
#include <string>

#include "clca/automaton/automaton.hpp"
#include "clca/render/coloring.hpp"
#include "clca/render/painter.hpp"
#include "clca/scene/scene.hpp"
#include "clca/store/run_folder.hpp"
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

 private:
  render::Coloring coloring(const automaton::Automaton& automaton) const;

  const scene::Scene& scene_;
  const scene::Frames& frames_;
  render::Painter painter_;
  FrameWriter writer_;
  std::string stage_;
  double displacement_scale_ = 1;  // lattice spacings
  std::optional<std::uint64_t> last_step_;
};

}  // namespace clca::run
