#include "render/framing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace clca::render {

namespace {

constexpr int kMaxSupersampling = 4;

/// Of the border that pictures show around the box, in lattice spacings.
double border_thickness(const lattice::Lattice& lattice) {
  const double width = lattice.columns() * lattice::kColumnPitch;
  return std::max(1.0, 0.005 * std::max(width, static_cast<double>(lattice.rows())));
}

/// Outlines are thin but at least a pixel wide, and fade out if sites become too small for them.
void set_outline(Projection& projection, double pixels_per_spacing, int picture_height) {
  constexpr double kThin = 0.1;   // lattice spacings
  constexpr double kThick = 0.2;  // must stay below 0.4, where the lookup loses sight of the edge
  constexpr double kNone = 1.5;   // pixels a spacing
  constexpr double kFull = 4.0;
  const double visible = std::max(0.8, picture_height / 1440.0) / pixels_per_spacing;
  projection.outline_width = std::clamp(visible, kThin, kThick);
  projection.outline_strength =
      std::clamp((pixels_per_spacing - kNone) / (kFull - kNone), 0.0, 1.0);
}

}  // namespace

Style completed(Style style, const lattice::Lattice& lattice) {
  if (style.width < 0 || style.height < 0) {
    throw RenderError(
        fmt::format("a picture of {} x {} pixels: at least 1 x 1", style.width, style.height));
  }
  if (style.supersampling < 1 || style.supersampling > kMaxSupersampling) {
    throw RenderError(fmt::format("supersampling is {}: 1 to {} are allowed", style.supersampling,
                                  kMaxSupersampling));
  }
  if (style.view == lattice::Rectangle{}) {
    style.view = whole_box(lattice);
  }
  const double width = style.view.right - style.view.left;
  const double height = style.view.top - style.view.bottom;
  if (!(width > 0 && height > 0 && std::isfinite(width) && std::isfinite(height))) {
    throw RenderError("the view to draw is empty or without bounds");
  }
  if (style.annotations != Annotations::none && !font_problem().empty()) {
    style.annotations = Annotations::none;
  }
  const PictureSize size = picture_size(style.width, style.height, style.view, style.annotations);
  style.width = size.width;
  style.height = size.height;
  return style;
}

Projection projection_of(const lattice::Rectangle& view, const Layout& layout, int samples,
                         const lattice::Lattice& lattice, int picture_height) {
  Projection projection;
  projection.width = layout.panel.width * samples;
  projection.height = layout.panel.height * samples;
  projection.scale = layout.scale * samples;
  projection.corner = {view.left, view.bottom};
  const lattice::Rectangle box = whole_box(lattice);
  const Eigen::Vector2d middle(std::clamp((view.left + view.right) / 2, box.left, box.right),
                               std::clamp((view.bottom + view.top) / 2, box.bottom, box.top));
  projection.anchor = lattice::nearest_site(middle);
  projection.anchor.column -= lattice::is_odd(projection.anchor.column) ? 1 : 0;
  set_outline(projection, layout.scale, picture_height);
  return projection;
}

lattice::Rectangle whole_box(const lattice::Lattice& lattice) {
  const double frame = border_thickness(lattice);
  const double side = lattice.periodic() ? 0 : frame;
  const double half = lattice::kColumnPitch / 2;
  return {.left = -half - side,
          .bottom = -0.5 - frame,
          .right = lattice.columns() * lattice::kColumnPitch - half + side,
          .top = static_cast<double>(lattice.rows())};
}

}  // namespace clca::render
