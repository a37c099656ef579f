#pragma once
// Forces and convection in pictures.

#include <vector>

#include "clca/render/legend.hpp"
#include "clca/render/overlays.hpp"
#include "clca/scene/scene.hpp"
#include "run/frame_painter.hpp"

namespace clca::run {

struct DrawnOverlay {
  render::Overlay overlay;
  std::vector<render::Legend::Line> keys;
};

/// The force network of contacts or overlaps, or the mean displacement per cycle.
/// `strongest_force`: contact model, drawn as the widest line.
DrawnOverlay overlay_of(scene::Overlay overlay, const View& view, double strongest_force);

/// Frames::force_scale or, by default, twice the weight of a column of grains as high as the fall
/// height, rounded to 1, 2 or 5 times a power of ten. Few forces exceed it.
double strongest_force(const scene::Scene& scene);

}  // namespace clca::run
