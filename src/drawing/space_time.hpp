#pragma once
// A column of the box or its free surface over time, as one picture.

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "clca/drawing/redraw.hpp"
#include "clca/store/trajectory.hpp"
#include "drawing/internal/frame_painter.hpp"

namespace clca::drawing {

/// Values of a line over time, as means in the pixels of a picture.
class TimeMeans {
 public:
  /// `width` pixels for the time from `begin` to `end`; `height` positions with `values` each.
  TimeMeans(int width, int height, int values, double begin, double end);

  /// `line` (values x rows, the lowest position first) holds from `from` to `to`; of that the part
  /// between `begin` and `end` counts.
  void add(double from, double to, const Eigen::ArrayXXd& line);

  int width() const { return static_cast<int>(weights_.size()); }
  int height() const { return static_cast<int>(rows_); }
  /// Whether any line holds at some time in the pixel column.
  bool is_known(int column) const { return weights_[column] > 0; }
  /// Mean over the time of a pixel column (from the left) at a position (from below).
  Eigen::ArrayXd mean(int column, int row) const;

 private:
  Eigen::Index rows_;
  double begin_;
  double columns_per_time_;
  Eigen::ArrayXXd sums_;    // values x (rows of the first column, of the second ...)
  Eigen::ArrayXd weights_;  // by column
};

class SpaceTimePainter {
 public:
  /// `initial`: before the first stage. `frames`: those to show, in their order; each holds until
  /// the next. Throws RedrawError.
  SpaceTimePainter(const scene::Scene& scene, const grains::State& initial,
                   const SpaceTimeOptions& options, std::vector<store::Trajectory::Frame> frames);

  /// Adds the frame `number`, which has this content.
  void add_frame(const PictureContent& content, const PictureHistory& history, std::size_t number);
  SpaceTimePicture picture();

 private:
  /// Means over the width of the slit in the picture of a frame: red, green, blue.
  Eigen::ArrayXXd slit_colors(const PictureContent& content, const PictureHistory& history);
  /// By column of the lattice: height in lattice spacings, and whether there are grains.
  Eigen::ArrayXXd surface_heights(const grains::State& state) const;
  /// `color_of(mean)`: the colour of a TimeMeans::mean().
  template <class ColorOf>
  image::Image image_of_means(ColorOf color_of) const;
  /// The height of the surface in colours. Adds to `legend` what they mean.
  image::Image surface_image(render::Legend& legend) const;

  SpaceTimeOptions options_;
  std::vector<store::Trajectory::Frame> frames_;
  lattice::Rectangle shown_part_;  // of the plane
  bool annotations_;
  scene::Scene scene_;  // its pictures show what lies in the slit
  FramePainter painter_;
  TimeMeans means_;
  std::optional<render::Legend> legend_;  // of a column
};

}  // namespace clca::drawing
