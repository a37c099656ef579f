#pragma once
// Strokes drawn into a finished picture.

#include "clca/render/image.hpp"
#include "clca/render/overlay.hpp"

namespace clca::render {

/// Lengths in pixels from the upper left corner. What leaves the picture is cut off; a stroke that
/// is not finite, or ends further than 1e12 pixels away, is left out.
void draw_stroke(Image& image, const Stroke& stroke);

/// Fades `panel` and draws the strokes over it. Its lower left corner lies at `corner` in lattice
/// spacings, `scale` pixels are one spacing.
void draw_overlay(Image& panel, const Overlay& overlay, const Eigen::Vector2d& corner,
                  double scale);

}  // namespace clca::render
