#pragma once
// Pictures of a line through the box over time: time to the right, position upwards.

#include <Eigen/Core>
#include <span>
#include <string>
#include <vector>

#include "clca/grains/occupancy.hpp"
#include "clca/grains/state.hpp"
#include "clca/render/coloring.hpp"
#include "clca/render/image.hpp"
#include "clca/render/legend.hpp"

namespace clca::render {

/// Values of a line over time, as means in the pixels of a picture.
class TimeMeans {
 public:
  /// `columns` pixels for the time from `begin` to `end`; `rows` positions with `values` each.
  TimeMeans(int columns, int rows, int values, double begin, double end);

  /// `line` (values x rows, the lowest position first) holds from `from` to `to`; of that the part
  /// between `begin` and `end` counts.
  void add(double from, double to, const Eigen::ArrayXXd& line);

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

/// What lies on a line.
struct LineColors {
  std::vector<Rgb> colors;  ///< by point; white where nothing is
  ShownWalls walls;
};

/// Of the particle or wall on the nearest site of each point (lattice spacings). `occupancy`
/// belongs to `state`.
LineColors line_colors(const grains::State& state, const grains::Occupancy& occupancy,
                       const Coloring& coloring, std::span<const Eigen::Vector2d> points);

struct Axis {
  std::string label;  ///< with the unit
  double low = 0;
  double high = 1;
};

/// A picture over time without what lies on the line.
struct TimePlot {
  struct Stage {
    std::string name;
    double begin = 0;  ///< on the axis of time
  };
  int width = 1280;  ///< pixels of the whole picture
  int height = 720;
  bool annotations = true;  ///< title, axes, legend; need a font
  std::string title;
  Axis time;
  Axis position;
  std::vector<Stage> stages;  ///< in their order; lines mark where one follows on another
  Legend legend;
};

/// The pixels between the axes.
PixelBox time_panel(const TimePlot& plot);

/// `content`: as large as the panel.
Image time_picture(const TimePlot& plot, const Image& content);

}  // namespace clca::render
