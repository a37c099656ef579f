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

/// The force network of the contacts or the present overlaps, or the mean displacement per cycle in
/// this stage. `strongest_force`: of the contact model, drawn as the widest line.
Drawn overlay_of(scene::Overlay overlay, const View& view, double strongest_force);

/// Frames::force_scale, or a force in weights of a grain that few in the beds of a scene of the
/// contact model exceed: twice the weight of a column of grains as high as the fall height, rounded
/// to 1, 2 or 5 times a power of ten.
double strongest_force(const scene::Scene& scene);

}  // namespace clca::run
