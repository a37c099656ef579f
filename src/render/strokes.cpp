#include "render/strokes.hpp"

#include <algorithm>
#include <cmath>

#include "render/blend.hpp"
#include "render/colors.hpp"
#include "render/stroke_mask.hpp"

namespace clca::render {

namespace {

constexpr double kMaxStrokeCoordinate =
    1e12;  // pixels, which doubles still tell apart to a thousandth
constexpr double kMaxStrokeWidth = 1e6;

bool drawable(const Stroke& stroke) {
  const auto near = [](double place) {
    return std::abs(place) < kMaxStrokeCoordinate;
  };  // false for NaN
  return near(stroke.from.x()) && near(stroke.from.y()) && near(stroke.to.x()) &&
         near(stroke.to.y()) && stroke.width > 0 && stroke.width < kMaxStrokeWidth;
}

/// Pixels of a row or rows of a picture.
struct PixelRange {
  int first = 0;
  int last = 0;  // exclusive
};

/// Pixels of `count` whose centre lies in `places`.
PixelRange span_of(const Interval& places, int count) {
  if (places.empty()) {
    return {};
  }
  const auto bounded = [count](double place) {
    return static_cast<int>(std::clamp(place, 0.0, static_cast<double>(count)));
  };
  return {bounded(std::ceil(places.low - 0.5)), bounded(std::floor(places.high + 0.5))};
}

void draw_row(Image& image, int row, const StrokeMask& mask, Rgb color) {
  const double y = row + 0.5;
  const PixelRange touched = span_of(mask.touched(y), image.width);
  const PixelRange covered = span_of(mask.covered(y), image.width);
  for (int x = touched.first; x < touched.last; ++x) {
    if (x == covered.first && covered.first < covered.last) {
      std::fill(&image.at(x, row), &image.at(covered.last - 1, row) + 1, color);
      x = covered.last - 1;
      continue;
    }
    const unsigned coverage = coverage_of(mask.coverage(x + 0.5, y));
    if (coverage > 0) {
      blend(image.at(x, row), color, coverage);
    }
  }
}

void fade(Image& image, double share) {
  const unsigned coverage = coverage_of(share);
  if (coverage == 0) {
    return;
  }
  for (Rgb& pixel : image.pixels) {
    blend(pixel, kPaper, coverage);
  }
}

}  // namespace

void draw_stroke(Image& image, const Stroke& stroke) {
  if (!drawable(stroke)) {
    return;
  }
  const StrokeMask mask(stroke);
  const double reach = mask.reach();
  const Eigen::Vector2d low = stroke.from.cwiseMin(stroke.to);
  const Eigen::Vector2d high = stroke.from.cwiseMax(stroke.to);
  if (high.x() + reach < 0 || low.x() - reach > image.width) {
    return;
  }
  const PixelRange rows = span_of({low.y() - reach, high.y() + reach}, image.height);
  for (int row = rows.first; row < rows.last; ++row) {
    draw_row(image, row, mask, stroke.color);
  }
}

void draw_overlay(Image& panel, const Overlay& overlay, const Eigen::Vector2d& corner,
                  double scale) {
  fade(panel, overlay.fade);
  const auto pixel = [&](const Eigen::Vector2d& place) {
    return Eigen::Vector2d((place.x() - corner.x()) * scale,
                           panel.height - (place.y() - corner.y()) * scale);
  };
  for (const Stroke& stroke : overlay.strokes) {
    draw_stroke(panel, {pixel(stroke.from), pixel(stroke.to), stroke.width * scale, stroke.color,
                        stroke.arrow});
  }
}

}  // namespace clca::render
