#pragma once
// Draws states as a scene wants its pictures: while it runs, and from a trajectory.

#include <string>

#include "clca/automaton/occupancy.hpp"
#include "clca/automaton/state.hpp"
#include "clca/render/coloring.hpp"
#include "clca/render/painter.hpp"
#include "clca/render/png.hpp"
#include "clca/scene/scene.hpp"
#include "run/cycle_record.hpp"

namespace clca::run {

/// What there is to draw.
struct View {
  const automaton::State& state;
  const automaton::Occupancy& occupancy;
  const CycleRecord* cycles = nullptr;  ///< none where the run is over: then no arrows
};

/// Where the colour bar of displacements ends in a stage, in lattice spacings: half the height of
/// the highest origin. `state`: as the stage begins, with the origins marked.
double displacement_scale(const automaton::State& state);

struct Picture {
  render::Image image;
  render::PngText text;
};

/// Where a picture comes from, without stage and step.
render::PngText scene_text(const scene::Scene& scene);

class FramePainter {
 public:
  /// `scene` has frames and outlives this. Throws ScenePlaceError when the driver cannot draw what
  /// it asks for.
  FramePainter(const scene::Scene& scene, const automaton::State& state);

  /// `scale`: the displacement_scale() of the stage.
  Picture draw(const View& view, const std::string& stage, double scale);

 private:
  render::Coloring coloring(const View& view, double scale) const;

  const scene::Scene& scene_;
  const scene::Frames& frames_;
  render::Painter painter_;
};

}  // namespace clca::run
