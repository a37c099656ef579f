#pragma once
// A column of the box or its free surface over time, as one picture.

#include <optional>
#include <string>
#include <vector>

#include "clca/render/space_time.hpp"
#include "clca/run/redraw.hpp"
#include "clca/store/trajectory.hpp"
#include "run/frame_painter.hpp"

namespace clca::run {

/// Of an axis or colour bar of lengths.
struct AxisUnit {
  std::string name;
  double spacing = 1;  ///< of the lattice
};

class SpaceTime {
 public:
  /// `frames`: those to show, in their order; each holds until the next. Throws RedrawError.
  SpaceTime(const scene::Scene& scene, const FramePainter& painter, const SpaceTimeOptions& options,
            std::vector<store::Trajectory::Frame> frames);

  /// Throws store::StoreError if the file could not be written.
  void require_writable() const;
  /// `view`: of the frame `number`.
  void add(const View& view, const PictureHistory& history, std::size_t number);
  /// Writes the picture of the frames so far.
  void finish();

 private:
  /// Middle of a row of pixels, counted from below, in lattice spacings.
  double position(int row) const;
  /// Points of the rows of pixels, in the box of a picture that is turned by `turn` degrees.
  std::vector<Eigen::Vector2d> line(double x, double turn) const;
  Eigen::ArrayXXd column(const View& view, const PictureHistory& history);
  Eigen::ArrayXXd surface(const grains::State& state) const;
  /// The means as colours.
  template <class ColorOf>
  render::Image content(ColorOf color_of) const;
  render::Image column_content();
  render::Image surface_content();

  const scene::Scene& scene_;
  const FramePainter& painter_;
  SpaceTimeOptions options_;
  std::vector<store::Trajectory::Frame> frames_;
  lattice::Rectangle shown_box_;  // of the plane that is shown
  AxisUnit unit_;
  render::TimePlot plot_;
  image::PixelBox panel_;
  // Red, green, blue of a column; height of the surface in lattice spacings and whether there are
  // grains.
  render::TimeMeans means_;
  std::optional<render::Legend> colors_;  // of a column
  render::ShownWalls walls_;
};

}  // namespace clca::run
