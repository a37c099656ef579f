#include "render/layout.hpp"

#include <fmt/format.h>

namespace clca::render {

namespace {

// In text sizes.
constexpr double kMargin = 1.0;
constexpr double kTopStrip = 2.4;
constexpr double kBottomStrip = 3.0;
constexpr double kMinPanel = 6.0;
constexpr double kTextWidth = 44;  // enough for most captions and legends

constexpr int kMinTextSize = 9;  // pixels, below which letters cannot be read
constexpr double kTextSizesInHeight = 42;
constexpr double kTextSizesInWidth = 50;  // matters in pictures narrower than 6:5

double top_strip(Annotations annotations) {
  return annotations == Annotations::all ? kTopStrip : kMargin;
}

}  // namespace

PixelBox picture_size(int width, int height, const lattice::Rectangle& view,
                      Annotations annotations) {
  constexpr double kArea = 1280.0 * 720.0;
  constexpr double kMinAspect = 0.4;  // width over height
  constexpr double kMaxAspect = 4;
  const double view_aspect = (view.right - view.left) / (view.top - view.bottom);
  double aspect = view_aspect;
  if (annotations != Annotations::none) {  // the same as in layout_of(), with the text size that
                                           // follows from height or width
    const double strips = top_strip(annotations) + kBottomStrip;
    aspect = (1 - strips / kTextSizesInHeight) * view_aspect + 2 * kMargin / kTextSizesInHeight;
    if (aspect < kTextSizesInWidth / kTextSizesInHeight) {
      aspect =
          1 / ((1 - 2 * kMargin / kTextSizesInWidth) / view_aspect + strips / kTextSizesInWidth);
    }
  }
  aspect = std::clamp(aspect, kMinAspect, kMaxAspect);
  const auto even = [](double pixels) {
    return std::max(2, 2 * static_cast<int>(std::lround(pixels / 2)));
  };
  if (width > 0) {
    return {.width = width, .height = height > 0 ? height : even(width / aspect)};
  }
  return {.width = even(height > 0 ? height * aspect : std::sqrt(kArea * aspect)),
          .height = height > 0 ? height : even(std::sqrt(kArea / aspect))};
}

Layout layout_of(int width, int height, const lattice::Rectangle& view, Annotations annotations) {
  const double wanted = std::min(height / kTextSizesInHeight, width / kTextSizesInWidth);
  const int letters = std::max(kMinTextSize, static_cast<int>(std::lround(wanted)));
  const bool room = width >= (2 * kMargin + kMinPanel) * letters &&
                    height >= (top_strip(annotations) + kBottomStrip + kMinPanel) * letters;
  const int text_size = annotations != Annotations::none && room ? letters : 0;
  const auto pixels = [&](double text_sizes) {
    return static_cast<int>(std::lround(text_sizes * text_size));
  };
  const int margin = pixels(kMargin);
  const int top = pixels(top_strip(annotations));
  const int room_width = width - 2 * margin;
  const int room_height = height - top - pixels(kBottomStrip);
  const double view_width = view.right - view.left;
  const double view_height = view.top - view.bottom;

  Layout layout;
  layout.text_size = text_size;
  layout.has_captions = annotations == Annotations::all;
  layout.pixels_per_spacing = std::min(room_width / view_width, room_height / view_height);
  PixelBox& panel = layout.panel;
  panel.width = std::max(1, static_cast<int>(std::lround(view_width * layout.pixels_per_spacing)));
  panel.height =
      std::max(1, static_cast<int>(std::lround(view_height * layout.pixels_per_spacing)));
  panel.x = margin + (room_width - panel.width) / 2;
  panel.y = top + (room_height - panel.height) / 2;
  // In line with the view, unless it is too narrow.
  const int text_width = std::max(panel.width, std::min(room_width, pixels(kTextWidth)));
  layout.text_left = margin + (room_width - text_width) / 2;
  layout.text_right = layout.text_left + text_width;
  return layout;
}

Style with_view_and_size(Style style, const lattice::Lattice& lattice) {
  constexpr int kMaxSupersampling = 4;
  constexpr int kMaxSize = 32'767;  // of Cairo
  if (style.width < 0 || style.height < 0) {
    throw RenderError(
        fmt::format("a picture of {} x {} pixels: at least 1 x 1", style.width, style.height));
  }
  if (style.supersampling < 1 || style.supersampling > kMaxSupersampling) {
    throw RenderError(fmt::format("supersampling is {}: 1 to {} are allowed", style.supersampling,
                                  kMaxSupersampling));
  }
  if (style.view == lattice::Rectangle{}) {
    style.view = box_with_frame(lattice);
  }
  const double width = style.view.right - style.view.left;
  const double height = style.view.top - style.view.bottom;
  if (!(width > 0 && height > 0 && std::isfinite(width) && std::isfinite(height))) {
    throw RenderError("the view to draw is empty or without bounds");
  }
  if (style.annotations != Annotations::none && !font_warning().empty()) {
    style.annotations = Annotations::none;
  }
  const PixelBox size = picture_size(style.width, style.height, style.view, style.annotations);
  if (std::max(size.width, size.height) > kMaxSize) {
    throw RenderError(fmt::format("a picture of {} x {} pixels is too large: {} x {} at most",
                                  size.width, size.height, kMaxSize, kMaxSize));
  }
  style.width = size.width;
  style.height = size.height;
  return style;
}

Projection projection_of(const lattice::Rectangle& view, const Layout& layout, int samples,
                         int picture_height) {
  // Outlines are thin but at least a pixel wide, and fade out if sites become too small for them.
  constexpr double kThin = 0.1;   // lattice spacings
  constexpr double kThick = 0.2;  // must stay below 0.4, where the lookup loses sight of the edge
  constexpr double kNone = 1.5;   // pixels a spacing
  constexpr double kFull = 4.0;
  const double visible = std::max(0.8, picture_height / 1440.0) / layout.pixels_per_spacing;
  return {.width = layout.panel.width * samples,
          .height = layout.panel.height * samples,
          .samples_per_spacing = layout.pixels_per_spacing * samples,
          .corner = {view.left, view.bottom},
          .outline_width = std::clamp(visible, kThin, kThick),
          .outline_strength =
              std::clamp((layout.pixels_per_spacing - kNone) / (kFull - kNone), 0.0, 1.0)};
}

lattice::Rectangle box_with_frame(const lattice::Lattice& lattice) {
  const double width = lattice.columns() * lattice::kColumnPitch;
  const double frame = std::max(1.0, 0.005 * std::max(width, static_cast<double>(lattice.rows())));
  const double side = lattice.periodic() ? 0 : frame;
  const double half = lattice::kColumnPitch / 2;
  return {.left = -half - side,
          .bottom = -0.5 - frame,
          .right = width - half + side,
          .top = static_cast<double>(lattice.rows())};
}

}  // namespace clca::render
