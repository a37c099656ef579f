#include "clca/render/space_time.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "clca/lattice/region.hpp"
#include "clca/render/painter.hpp"
#include "render/annotations.hpp"
#include "render/colors.hpp"
#include "render/graphics.hpp"
#include "render/layout.hpp"
#include "render/wall_appearance.hpp"

namespace clca::render {

namespace {

// In text sizes.
constexpr double kPlotTitleStrip = 2.2;
constexpr double kStageStrip = 1.4;
constexpr double kAxisStrip = 3.3;  // ticks, their numbers and the label of the axis of time
constexpr double kPlotLegendStrip = 3.0;
constexpr double kPositionStrip = 5.6;  // the same beside the axis of position
constexpr double kRightStrip = 1.8;
constexpr double kTickLength = 0.35;
constexpr double kTimePitch = 7.0;  // from number to number, at least
constexpr double kPositionPitch = 3.0;
constexpr double kHalfDigit = 0.36;  // from the middle of a line of text down to its baseline

/// Of title and legend around panel and axes.
Layout layout_of(const TimePlot& plot) {
  const Annotations annotations =
      plot.annotations && font_problem().empty() ? Annotations::all : Annotations::none;
  Layout layout;
  layout.text_size = arrange(plot.width, plot.height, {0, 0, 1, 1}, annotations).text_size;
  layout.scale = 0;
  const auto pixels = [&](double text_sizes) {
    return static_cast<int>(std::lround(text_sizes * layout.text_size));
  };
  layout.text_left = pixels(kPositionStrip);
  layout.text_right = plot.width - pixels(kRightStrip);
  layout.panel.x = layout.text_left;
  layout.panel.y = pixels(kPlotTitleStrip);
  layout.panel.width = layout.text_right - layout.text_left;
  layout.panel.height = plot.height - layout.panel.y - pixels(kPlotLegendStrip);
  return layout;
}

/// Draws axes and stages around the panel.
class TimeAxes {
 public:
  TimeAxes(Graphics& graphics, const TimePlot& plot, const PixelBox& panel, double text_size)
      : graphics_(graphics),
        plot_(plot),
        left_(panel.x),
        top_(panel.y),
        right_(panel.x + panel.width),
        bottom_(panel.y + panel.height),
        text_size_(text_size),
        line_(std::max(1.0, std::round(0.07 * text_size))) {}

  void draw_stage_lines() {
    for (std::size_t i = 1; i < plot_.stages.size(); ++i) {
      const double x = std::round(x_of(plot_.stages[i].begin) - line_ / 2);
      graphics_.fill_box(x - line_, top_, x + 2 * line_, bottom_, kPaper);
      graphics_.fill_box(x, top_, x + line_, bottom_, kInk);
    }
  }

  void draw_around() {
    graphics_.fill_box(left_ - line_, top_ - line_, left_, bottom_ + line_, kInk);
    graphics_.fill_box(right_, top_ - line_, right_ + line_, bottom_ + line_, kInk);
    graphics_.fill_box(left_, top_ - line_, right_, top_, kInk);
    graphics_.fill_box(left_, bottom_, right_, bottom_ + line_, kInk);
    draw_time_axis();
    draw_position_axis();
    if (plot_.stages.size() > 1) {
      draw_stage_names();
    }
  }

 private:
  double em(double text_sizes) const { return text_sizes * text_size_; }
  double x_of(double time) const {
    const Axis& axis = plot_.time;
    return left_ + (time - axis.low) / (axis.high - axis.low) * (right_ - left_);
  }
  double y_of(double position) const {
    const Axis& axis = plot_.position;
    return bottom_ - (position - axis.low) / (axis.high - axis.low) * (bottom_ - top_);
  }
  static int count_of(double room, double pitch) {
    return std::max(2, static_cast<int>(room / pitch) + 1);
  }
  Graphics::Text text(const std::string& text, double room) {
    return graphics_.text(text, text_size_, room);
  }
  Graphics::Text number(double value) { return text(fmt::format("{:.8g}", value), em(9)); }

  void draw_time_axis() {
    const double low = bottom_ + line_ + em(kTickLength);
    for (const double value :
         ticks(plot_.time.low, plot_.time.high, count_of(right_ - left_, em(kTimePitch)))) {
      const double x = std::round(x_of(value) - line_ / 2);
      graphics_.fill_box(x, bottom_, x + line_, low, kInk);
      const Graphics::Text label = number(value);
      graphics_.draw_text(label, x - label.width() / 2, low + em(1.0), kInk);
    }
    const Graphics::Text label = text(plot_.time.label, right_ - left_);
    graphics_.draw_text(label, (left_ + right_ - label.width()) / 2, bottom_ + em(2.85), kInk);
  }

  void draw_position_axis() {
    const double end = left_ - line_ - em(kTickLength);
    for (const double value : ticks(plot_.position.low, plot_.position.high,
                                    count_of(bottom_ - top_, em(kPositionPitch)))) {
      const double y = std::round(y_of(value) - line_ / 2);
      graphics_.fill_box(end, y, left_, y + line_, kInk);
      const Graphics::Text label = number(value);
      graphics_.draw_text(label, end - em(0.3) - label.width(), y + em(kHalfDigit), kInk);
    }
    const double half = (bottom_ - top_) / 2;
    const Graphics::Panel turned(graphics_, em(1.2) - half, top_, 2 * half, 2 * half, 90);
    const Graphics::Text label = text(plot_.position.label, 2 * half);
    graphics_.draw_text(label, half - label.width() / 2, half + em(kHalfDigit), kInk);
  }

  /// Where they have room.
  void draw_stage_names() {
    for (std::size_t i = 0; i < plot_.stages.size(); ++i) {
      const double left = std::max<double>(left_, x_of(plot_.stages[i].begin));
      const double right =
          i + 1 < plot_.stages.size() ? x_of(plot_.stages[i + 1].begin) : double{right_};
      const double room = right - left - em(0.4);
      if (room > em(2)) {
        const Graphics::Text name = text(plot_.stages[i].name, room);
        graphics_.draw_text(name, (left + right - name.width()) / 2, top_ - em(0.5), kPaleInk);
      }
    }
  }

  Graphics& graphics_;
  const TimePlot& plot_;
  double left_;
  double top_;
  double right_;
  double bottom_;
  double text_size_;
  double line_;  // thickness
};

}  // namespace

TimeMeans::TimeMeans(int columns, int rows, int values, double begin, double end)
    : rows_(rows),
      begin_(begin),
      columns_per_time_(columns / (end - begin)),
      sums_(Eigen::ArrayXXd::Zero(values, Eigen::Index{columns} * rows)),
      weights_(Eigen::ArrayXd::Zero(columns)) {}

void TimeMeans::add(double from, double to, const Eigen::ArrayXXd& line) {
  const auto columns = static_cast<double>(weights_.size());
  const double left = std::clamp((from - begin_) * columns_per_time_, 0.0, columns);
  const double right = std::clamp((to - begin_) * columns_per_time_, 0.0, columns);
  for (auto column = static_cast<Eigen::Index>(left); static_cast<double>(column) < right;
       ++column) {
    const auto x = static_cast<double>(column);
    const double share = std::min(right, x + 1) - std::max(left, x);
    sums_.middleCols(column * rows_, rows_) += share * line;
    weights_[column] += share;
  }
}

Eigen::ArrayXd TimeMeans::mean(int column, int row) const {
  return sums_.col(column * rows_ + row) / weights_[column];
}

LineColors line_colors(const grains::State& state, const grains::Occupancy& occupancy,
                       const Coloring& coloring, std::span<const Eigen::Vector2d> points) {
  LineColors result = {.colors = std::vector<Rgb>(points.size(), kPaper), .walls = {}};
  for (std::size_t i = 0; i < points.size(); ++i) {
    const lattice::Site site = lattice::nearest_site(points[i]);
    const grains::Owner owner =
        state.lattice.contains(site) ? occupancy.owner(state.lattice.index(site)) : grains::kFree;
    if (grains::is_particle(owner)) {
      result.colors[i] = color(coloring, state, occupancy, grains::particle_id(owner));
    } else if (grains::is_wall(owner)) {
      const bool moving = moves(state.walls[grains::wall_number(owner)]);
      result.colors[i] = moving ? kMovingWallColor : kWallColor;
      (moving ? result.walls.moving : result.walls.standing) = true;
    }
  }
  return result;
}

PixelBox time_panel(const TimePlot& plot) {
  const Layout layout = layout_of(plot);
  const auto pixels = [&](double text_sizes) {
    return static_cast<int>(std::lround(text_sizes * layout.text_size));
  };
  const int names = plot.stages.size() > 1 ? pixels(kStageStrip) : 0;
  const PixelBox& box = layout.panel;
  return {box.x, box.y + names, box.width, box.height - names - pixels(kAxisStrip)};
}

Image time_picture(const TimePlot& plot, const Image& content) {
  const Layout layout = layout_of(plot);
  const PixelBox panel = time_panel(plot);
  Graphics graphics(plot.width, plot.height);
  graphics.draw_image(content, panel.x, panel.y, panel.width, panel.height);
  TimeAxes axes(graphics, plot, panel, layout.text_size);
  axes.draw_stage_lines();
  if (layout.text_size > 0) {
    axes.draw_around();
    annotate(graphics, layout, {.title = plot.title, .detail = ""}, plot.legend);
  }
  return graphics.image();
}

}  // namespace clca::render
