#pragma once
// What a picture shows of forces and convection.

#include <vector>

#include "clca/render/legend.hpp"
#include "clca/render/overlays.hpp"
#include "clca/scene/scene.hpp"
#include "run/frame_painter.hpp"

namespace clca::run {

struct Drawn {
  render::Overlay overlay;
  std::vector<render::Legend::Line> keys;
};

/// The force network of the present overlaps, or the mean displacement per cycle in this stage.
Drawn overlay_of(scene::Overlay overlay, const View& view);

}  // namespace clca::run
