#pragma once
// Draws states as a scene wants its pictures: while it runs, and from a trajectory.

#include <cstdint>
#include <optional>
#include <string>

#include "clca/automaton/occupancy.hpp"
#include "clca/automaton/state.hpp"
#include "clca/fields/fields.hpp"
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

/// What the pictures so far leave to those that come: goes into a checkpoint.
struct PictureHistory {
  std::string stage;
  double displacement_scale = 1;           ///< end of the colour bar, lattice spacings
  render::LayerRange layers;               ///< as the stage began
  std::optional<std::uint64_t> last_step;  ///< that was drawn

  static constexpr auto fields() {
    return std::make_tuple(fields::field("stage", &PictureHistory::stage),
                           fields::field("displacement_scale", &PictureHistory::displacement_scale),
                           fields::field("layers", &PictureHistory::layers),
                           fields::field("last_step", &PictureHistory::last_step));
  }
};

/// Sets what the pictures of a stage have in common. `state`: as the stage begins, with the origins
/// marked.
void begin_stage(PictureHistory& history, const std::string& stage, const automaton::State& state);

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

  Picture draw(const View& view, const PictureHistory& history);

 private:
  render::Coloring coloring(const View& view, const PictureHistory& history) const;

  const scene::Scene& scene_;
  const scene::Frames& frames_;
  render::Painter painter_;
};

}  // namespace clca::run
