#pragma once
// The frame of a chart or map: where values lie in its picture, and its axes.

#include <string>
#include <string_view>

#include "report/axis.hpp"

namespace clca::report {

/// Lengths in units of the picture, which is 560 wide.
class PlotFrame {
 public:
  PlotFrame(Axis x, Axis y) : x_(std::move(x)), y_(std::move(y)) {}
  /// A spacing is as long upwards as across; at most `most_height` high.
  static PlotFrame with_equal_scales(Axis x, Axis y, double most_height);

  static double left() { return kLeft; }
  double right() const { return kLeft + width_; }
  static double top() { return kTop; }
  double bottom() const { return kTop + height_; }
  double x_of(double value) const { return left() + width_ * x_.part(value); }
  /// Values beyond the axis, as the edge of a band may have, lie at its end.
  double y_of(double value) const;
  /// Length of one unit across.
  double scale() const { return width_ / (x_.high() - x_.low()); }

  /// Ticks, labels and lines; the title below.
  std::string axes(std::string_view x_title) const;
  /// viewBox of the whole picture.
  std::string view_box() const;

 private:
  static constexpr double kWidth = 560;
  static constexpr double kLeft = 64;
  static constexpr double kRight = 18;
  static constexpr double kTop = 22;
  static constexpr double kBottom = 52;

  Axis x_;
  Axis y_;
  double width_ = kWidth - kLeft - kRight;
  double height_ = 250;
};

}  // namespace clca::report
