#pragma once
// Strokes drawn into a finished picture.

#include "clca/render/image.hpp"
#include "clca/render/overlay.hpp"

namespace clca::render {

/// Lengths in pixels from the upper left corner; clipped. Strokes that are not finite or end
/// further than 1e12 pixels away are left out.
void draw_stroke(Image& image, const Stroke& stroke);

/// Fades `panel` and draws the strokes over it. Its lower left corner is at `corner` (lattice
/// spacings); `scale` pixels per spacing.
void draw_overlay(Image& panel, const Overlay& overlay, const Eigen::Vector2d& corner,
                  double scale);

}  // namespace clca::render
