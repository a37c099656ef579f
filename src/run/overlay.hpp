#pragma once
// Forces, convection and velocities in pictures.

#include <vector>

#include "clca/render/legend.hpp"
#include "clca/render/overlays.hpp"
#include "run/frame_painter.hpp"
#include "run/overlay_scales.hpp"

namespace clca::run {

struct DrawnOverlay {
  render::Overlay overlay;
  std::vector<render::Legend::Line> keys;
};

/// The force network of contacts or overlaps, the mean displacement per cycle, or the mean velocity
/// since the last picture.
DrawnOverlay overlay_of(scene::Overlay overlay, const View& view, const PictureHistory& history,
                        const OverlayScales& scales);

}  // namespace clca::run
