#include "render/stroke_mask.hpp"

#include <limits>

namespace clca::render {

namespace {

constexpr double kHeadLength = 4.0;   // in widths of the shaft
constexpr double kHeadShare = 0.65;   // of the whole arrow at most
constexpr double kShaftShare = 0.45;  // of the head's width at most
constexpr double kDot = 0.7;          // diameter, in widths of the shaft

Interval common(const Interval& a, const Interval& b) {
  return {std::max(a.low, b.low), std::min(a.high, b.high)};
}

Interval hull(const Interval& a, const Interval& b) {
  if (a.empty() || b.empty()) {
    return a.empty() ? b : a;
  }
  return {std::min(a.low, b.low), std::max(a.high, b.high)};
}

/// The x for which `slope` x + `start` is in `range`.
Interval solve(double slope, double start, const Interval& range) {
  if (std::abs(slope) < 1e-9) {
    constexpr double kFar = std::numeric_limits<double>::max();
    return range.low <= start && start <= range.high ? Interval{-kFar, kFar} : Interval{1, 0};
  }
  const double one = (range.low - start) / slope;
  const double other = (range.high - start) / slope;
  return {std::min(one, other), std::max(one, other)};
}

}  // namespace

StrokeMask::StrokeMask(const Stroke& stroke)
    : x_(stroke.from.x()), y_(stroke.from.y()), half_width_(stroke.width / 2) {
  const double dx = stroke.to.x() - x_;
  const double dy = stroke.to.y() - y_;
  length_ = std::sqrt(dx * dx + dy * dy);
  if (length_ > 0) {
    along_x_ = dx / length_;
    along_y_ = dy / length_;
  }
  shaft_ = length_;
  if (stroke.arrow) {
    shape_arrow();
  }
}

void StrokeMask::shape_arrow() {
  const double width = 2 * half_width_;
  if (length_ < std::max(width, 1.0)) {
    x_ += along_x_ * length_ / 2;
    y_ += along_y_ * length_ / 2;
    shaft_ = 0;
    half_width_ *= kDot;
    return;
  }
  head_length_ = std::min(kHeadLength * width, kHeadShare * length_);
  head_half_width_ = kHeadSlope * head_length_;
  half_width_ = std::min(half_width_, kShaftShare * head_half_width_);
  shaft_ = length_ - head_length_;
}

Interval StrokeMask::touched(double y) const {
  const double end = half_width_ + 0.5;
  const Interval shaft = stretch(y, {-end, shaft_ + end}, end);
  if (head_length_ == 0) {
    return shaft;
  }
  return hull(shaft, stretch(y, {shaft_ - kRim, length_ + kRim}, head_half_width_ + kRim));
}

Interval StrokeMask::covered(double y) const {
  return half_width_ < 0.5 ? Interval{1, 0} : stretch(y, {0, shaft_}, half_width_ - 0.5);
}

Interval StrokeMask::stretch(double y, const Interval& along, double across) const {
  const double dy = y - y_;
  const Interval on_length = solve(along_x_, dy * along_y_, along);
  const Interval on_width = solve(along_y_, -dy * along_x_, {-across, across});
  const Interval both = common(on_length, on_width);
  return {both.low + x_, both.high + x_};
}

}  // namespace clca::render
