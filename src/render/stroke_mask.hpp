#pragma once
// The coverage of a stroke in pixels.

#include <algorithm>
#include <cmath>

#include "clca/render/overlay.hpp"

namespace clca::render {

/// Real numbers from `low` to `high`; empty if high < low.
struct Interval {
  double low = 0;
  double high = 0;

  bool empty() const { return !(low <= high); }
};

/// Gives the share of each pixel that the stroke covers; lengths in pixels.
class StrokeMask {
 public:
  explicit StrokeMask(const Stroke& stroke);

  /// Distance from the line between the ends to the furthest touched pixel.
  double reach() const { return std::max(half_width_, head_half_width_) + kRim; }

  /// The interval at height `y` outside which the coverage is 0.
  Interval touched(double y) const;
  /// An interval at height `y` inside which the coverage is 1.
  Interval covered(double y) const;

  double coverage(double x, double y) const {
    const double along = (x - x_) * along_x_ + (y - y_) * along_y_;
    const double across = std::abs((x - x_) * along_y_ - (y - y_) * along_x_);
    const double beyond = along < 0 ? along : along > shaft_ ? along - shaft_ : 0.0;
    const double distance = beyond != 0 ? std::sqrt(beyond * beyond + across * across) : across;
    const double shaft = band_coverage(distance, half_width_);
    return head_length_ > 0 ? std::max(shaft, head_coverage(along, across)) : shaft;
  }

 private:
  static constexpr double kRim = 1.5;  // beside the tip of an arrow, pixels still have a part of it
  static constexpr double kHeadSlope = 0.42;  // half the head's width over its length

  void shape_arrow();
  Interval stretch(double y, const Interval& along, double across) const;

  /// Covered share of a pixel at `distance` from the middle of a band.
  static double band_coverage(double distance, double half_width) {
    const double high = std::min(distance + 0.5, half_width);
    const double low = std::max(distance - 0.5, -half_width);
    return std::clamp(high - low, 0.0, 1.0);
  }

  double head_coverage(double along, double across) const {
    const double from_base = along - shaft_;
    const double from_side =
        (kHeadSlope * (length_ - along) - across) / std::sqrt(1 + kHeadSlope * kHeadSlope);
    return std::clamp(std::min(from_base, from_side) + 0.5, 0.0, 1.0);
  }

  double x_;  // of the beginning
  double y_;
  double half_width_;
  double along_x_ = 1;
  double along_y_ = 0;
  double length_ = 0;
  double shaft_ = 0;  // length without the head
  double head_length_ = 0;
  double head_half_width_ = 0;
};

}  // namespace clca::render
