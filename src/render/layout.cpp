#include "render/layout.hpp"

#include <algorithm>
#include <cmath>

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

/// Height above the view.
double top_strip(Annotations annotations) {
  return annotations == Annotations::all ? kTopStrip : kMargin;
}

Layout fit(int width, int height, const lattice::Rectangle& view, Annotations annotations,
           int text_size) {
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
  layout.captions = annotations == Annotations::all;
  layout.scale = std::min(room_width / view_width, room_height / view_height);
  PixelBox& panel = layout.panel;
  panel.width = std::max(1, static_cast<int>(std::lround(view_width * layout.scale)));
  panel.height = std::max(1, static_cast<int>(std::lround(view_height * layout.scale)));
  panel.x = margin + (room_width - panel.width) / 2;
  panel.y = top + (room_height - panel.height) / 2;
  // In line with the view, unless it is too narrow.
  const int text_width = std::max(panel.width, std::min(room_width, pixels(kTextWidth)));
  layout.text_left = margin + (room_width - text_width) / 2;
  layout.text_right = layout.text_left + text_width;
  return layout;
}

}  // namespace

PictureSize picture_size(int width, int height, const lattice::Rectangle& view,
                         Annotations annotations) {
  constexpr double kArea = 1280.0 * 720.0;
  constexpr double kMinAspect = 0.4;  // width over height
  constexpr double kMaxAspect = 4;
  const double view_aspect = (view.right - view.left) / (view.top - view.bottom);
  double aspect = view_aspect;
  if (annotations != Annotations::none) {  // the same as in fit(), with the text size that follows
                                           // from height or width
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
    return {width, height > 0 ? height : even(width / aspect)};
  }
  return height > 0 ? PictureSize{even(height * aspect), height}
                    : PictureSize{even(std::sqrt(kArea * aspect)), even(std::sqrt(kArea / aspect))};
}

Layout arrange(int width, int height, const lattice::Rectangle& view, Annotations annotations) {
  const double wanted = std::min(height / kTextSizesInHeight, width / kTextSizesInWidth);
  const int text_size = std::max(kMinTextSize, static_cast<int>(std::lround(wanted)));
  const bool room = width >= (2 * kMargin + kMinPanel) * text_size &&
                    height >= (top_strip(annotations) + kBottomStrip + kMinPanel) * text_size;
  return fit(width, height, view, annotations,
             annotations != Annotations::none && room ? text_size : 0);
}

}  // namespace clca::render
