#pragma once
// Forces, convection and velocities in pictures, with scales that are the same in all pictures of a
// run.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "clca/grains/state.hpp"
#include "clca/render/legend.hpp"
#include "clca/render/overlays.hpp"
#include "clca/scene/scene.hpp"
#include "clca/scene/units.hpp"

namespace clca::drawing {

struct PictureContent;
struct PictureHistory;

struct OverlayScales {
  std::optional<scene::Conversion> conversion = {};
  /// Drawn as the widest line, in unit_of(scene::kContactForceUnit).
  double strongest_force = 1;
  /// Contact model: end of the colours by pressure, in unit_of(scene::kStressUnit).
  double highest_pressure = 1;
  /// Side of the cells of velocities, lattice spacings.
  double velocity_cell = 1;
  /// Half of the end of the colours by speed, in `velocity_unit`.
  double highest_velocity = 1;
  /// Drawn as an arrow of 0.9 cells, in `velocity_unit`. None: by the arrows of each picture.
  std::optional<double> arrow_velocity = {};
  /// Contact model: of a grain of mean diameter that rolls at the highest velocity, radians per
  /// unit of time.
  double highest_spin = 1;
  /// A lattice spacing per step, in `velocity_unit`.
  double step_velocity = 1;
  render::UnitName velocity_unit;

  /// The unit of pictures in place of one of the contact model: in SI where there is a density.
  std::string unit_of(std::string_view unit) const;
  /// One `unit` of the contact model, in unit_of(unit). `state` gives the mean mass of grains.
  double value_of(std::string_view unit, const grains::State& state) const;
};

/// From the keys of `output.frames`. Their defaults:
/// - the strongest force is twice the weight of a column of grains as high as the fall height, of
///   as many of each species, rounded to 1, 2 or 5 times a power of ten; few forces exceed it;
/// - the highest pressure is that force over the mean diameter;
/// - a cell is 3 mean diameters of the species wide, and at least a 30th of the view;
/// - the highest velocity is half a spacing per step, or with the contact model half of that after
///   a fall from the fall height, rounded down in the same way.
OverlayScales overlay_scales(const scene::Scene& scene);

/// The velocity drawn as an arrow of 0.9 cells where velocities are about `typical`.
double arrow_velocity_for(double typical, const OverlayScales& scales);
/// The typical velocity of the arrows of a picture; 0 where there are none.
double typical_velocity(const PictureContent& content, const PictureHistory& history,
                        const OverlayScales& scales);

struct DrawnOverlay {
  render::Overlay overlay;
  std::vector<render::Legend::Line> legend_lines;
};

/// The force network of contacts or overlaps, the mean displacement per cycle, or the mean velocity
/// since the last picture.
DrawnOverlay overlay_of(scene::Overlay overlay, const PictureContent& content,
                        const PictureHistory& history, const OverlayScales& scales);

}  // namespace clca::drawing
