#pragma once
// Draws states as a scene wants its pictures: while it runs, and from a trajectory.

#include <cstdint>
#include <optional>
#include <string>

#include "clca/contact/force.hpp"
#include "clca/contact/vessel.hpp"
#include "clca/fields/fields.hpp"
#include "clca/grains/occupancy.hpp"
#include "clca/grains/state.hpp"
#include "clca/render/coloring.hpp"
#include "clca/render/painter.hpp"
#include "clca/render/png.hpp"
#include "clca/scene/scene.hpp"
#include "clca/scene/units.hpp"
#include "run/cycle_record.hpp"

namespace clca::run {

/// What there is to draw.
struct View {
  const grains::State& state;
  const grains::Occupancy& occupancy;
  const CycleRecord* cycles = nullptr;  ///< none where the run is over: then no arrows
  const std::vector<contact::Force>* forces = nullptr;  ///< of the contact model
  contact::Angle angle = 0;                             ///< of the vessel
};

/// What the pictures so far leave to those that come: goes into a checkpoint.
struct PictureHistory {
  std::string stage;
  double displacement_scale = 1;  ///< end of the colour bar, lattice spacings
  render::LayerRange layers;
  std::optional<std::uint64_t> last_step;  ///< that was drawn

  static constexpr auto fields() {
    return std::make_tuple(fields::field("stage", &PictureHistory::stage),
                           fields::field("displacement_scale", &PictureHistory::displacement_scale),
                           fields::field("layers", &PictureHistory::layers),
                           fields::field("last_step", &PictureHistory::last_step));
  }
};

/// Sets what the pictures of a stage have in common, by a look at all particles. `state`: as the
/// stage begins, with the origins marked.
void begin_stage(PictureHistory& history, const scene::Stage& stage, const grains::State& state);

/// A picture before it is developed, with what is written around it.
struct Negative {
  render::Exposure exposure;
  render::Caption caption;
  render::Overlay overlay;
  double turn = 0;  ///< degrees anticlockwise
  render::PngText text;
};

struct Picture {
  render::Image image;
  std::string moment;  ///< stage and step, or time
  render::PngText text;
};

/// Where a picture comes from, without stage and step.
render::PngText scene_text(const scene::Scene& scene);

/// One thread may expose the next picture while another one develops.
class FramePainter {
 public:
  /// `scene` has frames and outlives this. `threads` share the work of exposing. Throws
  /// ScenePlaceError when the driver cannot draw what it asks for.
  FramePainter(const scene::Scene& scene, const grains::State& state, int threads);

  /// Takes what the picture needs of the state, which may go on then.
  Negative expose(const View& view, const PictureHistory& history);
  Picture develop(const Negative& negative);

 private:
  render::Coloring coloring(const View& view, const PictureHistory& history) const;

  const scene::Scene& scene_;
  const scene::Frames& frames_;
  std::optional<scene::Conversion> conversion_;
  double strongest_force_;
  render::Painter painter_;
};

}  // namespace clca::run
