#pragma once
// Draws states as the scene specifies, during a run or from a trajectory.

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "clca/contact/vessel.hpp"
#include "clca/grains/occupancy.hpp"
#include "clca/grains/state.hpp"
#include "clca/image/png.hpp"
#include "clca/measure/displacement.hpp"
#include "clca/reflection/reflection.hpp"
#include "clca/render/coloring.hpp"
#include "clca/render/contact_sheet.hpp"
#include "clca/render/overlays.hpp"
#include "clca/render/painter.hpp"
#include "clca/scene/scene.hpp"
#include "clca/scene/units.hpp"
#include "clca/store/trajectory.hpp"
#include "record/internal/cycle_record.hpp"

namespace clca::drawing {

struct PictureContent {
  const grains::State& state;
  grains::Occupancy occupancy;
  const record::CycleRecord* cycles = nullptr;      ///< none where the run is over: then no arrows
  std::optional<store::ContactFrame> contact = {};  ///< of the contact model: what is shown
  contact::Angle vessel_angle = 0;                  ///< of the vessel
};

PictureContent current_content(const scene::Scene& scene, const model::SceneModel& model,
                               const record::Observers& observers);

lattice::Rectangle view_rectangle(const scene::PictureOutput& frames,
                                  const lattice::Lattice& lattice);

/// What later pictures need to know of earlier ones; part of a checkpoint.
struct PictureHistory {
  std::string stage;
  double displacement_scale = 1;  ///< end of the colour bar, lattice spacings
  render::LayerRange layers;
  std::optional<std::uint64_t> last_step;  ///< that was drawn
  /// Positions at the last picture or the start of the stage, if
  /// scene::pictures_compare_positions().
  std::optional<measure::Snapshot> window = {};

  CLCA_FIELDS(stage, displacement_scale, layers, last_step, window);
};

/// Sets what all pictures of a stage share. `state`: at the start of the stage, with the origins
/// marked.
void begin_stage(PictureHistory& history, const scene::Scene& scene, const scene::Stage& stage,
                 const grains::State& state);
void begin_window(PictureHistory& history, const scene::Scene& scene, const grains::State& state);

/// Scales of overlays and colours, the same in all pictures of a run.
struct OverlayScales {
  std::optional<scene::UnitConversion> conversion = {};
  /// Drawn as the widest line, in picture_unit(scene::kContactForceUnit).
  double strongest_force = 1;
  /// Contact model: end of the colours by pressure, in picture_unit(scene::kStressUnit).
  double highest_pressure = 1;
  double velocity_cell_size = 1;  ///< side of the cells of velocities, lattice spacings
  double middle_speed = 1;        ///< speed in the middle of its colour bar, in `velocity_unit`
  /// Drawn as an arrow of 0.9 cells, in `velocity_unit`. None: by the arrows of each picture.
  std::optional<double> arrow_velocity = {};
  /// Contact model: of a grain of mean diameter that rolls at the middle speed, radians per
  /// unit of time.
  double highest_spin = 1;
  double step_velocity = 1;  ///< a lattice spacing per step, in `velocity_unit`
  render::UnitName velocity_unit;

  /// The unit in pictures for a unit of the contact model: in SI where there is a density.
  std::string picture_unit(std::string_view unit) const;
  /// One `unit` of the contact model, in picture_unit(unit). `state` gives the mean mass of grains.
  double unit_factor(std::string_view unit, const grains::State& state) const;
};

/// From the keys of `output.frames`. Their defaults:
/// - the strongest force is twice the weight of a column of grains as high as the fall height, of
///   as many of each species, rounded to 1, 2 or 5 times a power of ten; few forces exceed it;
/// - the highest pressure is that force over the mean diameter;
/// - a cell is 3 mean diameters of the species wide, and at least a 30th of the view;
/// - the middle speed is half a spacing per step, or with the contact model half of that after
///   a fall from the fall height, rounded down in the same way.
OverlayScales overlay_scales(const scene::Scene& scene);

/// The velocity drawn as an arrow of 0.9 cells where velocities are about `typical`.
double arrow_velocity_for(double typical, const OverlayScales& scales);
/// The typical velocity of the arrows of a picture; 0 where there are none.
double typical_velocity(const PictureContent& content, const PictureHistory& history,
                        const OverlayScales& scales);

/// The force network of contacts or overlaps, the mean displacement per cycle, or the mean velocity
/// since the last picture.
render::Overlay overlay_of(scene::Overlay overlay, const PictureContent& content,
                           const PictureHistory& history, const OverlayScales& scales);

struct CapturedFrame {
  render::Capture capture;
  render::Caption caption;
  render::Overlay overlay;
  double turn_degrees = 0;  ///< degrees anticlockwise
  image::PngText text;
};

struct Picture {
  render::Image image;
  std::string moment_text;  ///< stage and step, or time
  render::Legend legend;
  image::PngText text;
};

/// Provenance of a picture, without stage and step.
image::PngText scene_metadata(const scene::Scene& scene);

struct PictureUse {
  int threads = 1;       ///< of captures
  bool for_pdf = false;  ///< captures serve FramePainter::pdf()
  int tile_width = 0;    ///< pixels; not 0: tiles of a contact sheet alone, nothing around the view
};

/// One thread may capture the next picture while another rasterizes.
class FramePainter {
 public:
  /// `scene` has frames and outlives this object. Throws scene::SceneError if the driver cannot
  /// draw it.
  FramePainter(const scene::Scene& scene, const grains::State& state, const PictureUse& use);

  /// Bytes for pictures of so many particles, with so many captures at a time.
  static double bytes_for(const scene::Scene& scene, double particles, int captures);

  /// The scales of all pictures; set arrow_velocity before the first one, so that all share it.
  OverlayScales& scales() { return scales_; }

  /// Reads what the picture needs; the state may change afterwards.
  CapturedFrame capture(const PictureContent& content, const PictureHistory& history);
  Picture rasterize(const CapturedFrame& frame);
  std::vector<std::uint8_t> pdf(const CapturedFrame& frame);

  /// The tile of a contact sheet, without label.
  render::Tile tile(const Picture& picture, int width) const;
  render::PixelBox view_box() const { return painter_.view().box; }  ///< where the particles are

  int width() const { return painter_.width(); }  ///< pixels of a picture
  int height() const { return painter_.height(); }

 private:
  render::Coloring coloring(const PictureContent& content, const PictureHistory& history) const;

  const scene::Scene& scene_;
  const scene::PictureOutput& frames_;
  OverlayScales scales_;
  render::Painter painter_;
};

/// Draws the frames that the scene requests, or the last one alone. Throws scene::SceneError if the
/// driver cannot draw them.
std::unique_ptr<record::Observer> pictures_observer(const scene::Scene& scene,
                                                    const grains::State& state, int threads,
                                                    bool only_last);

/// Most bytes of a pictures_observer(), with its part of a checkpoint; 0 without frames.
double picture_memory_bytes(const scene::Scene& scene, double particles);

}  // namespace clca::drawing
