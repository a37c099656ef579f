#include "run/space_time.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "clca/measure/profile.hpp"
#include "clca/render/painter.hpp"
#include "clca/store/file.hpp"

namespace clca::run {

namespace {

// Pixels, where the scene gives none.
constexpr int kUsualWidth = 1280;
constexpr int kUsualHeight = 720;

constexpr render::Rgb kWhite = {255, 255, 255};
constexpr double kBare = 0.5;  // share of the time with grains below which there is no surface

lattice::Lattice lattice_of(const scene::Scene& scene) {
  return lattice::Lattice::covering(scene.box.width, scene.box.height, scene.box.periodic);
}

lattice::Rectangle view_of(const scene::Scene& scene) {
  return scene.output.frames->view.value_or(render::whole_box(lattice_of(scene)));
}

/// The part of the view in which there may be grains: that in the box, unless the picture is
/// turned.
lattice::Rectangle shown_part(const scene::Scene& scene) {
  const lattice::Rectangle view = view_of(scene);
  if (scene.output.frames->upright) {
    return view;
  }
  const Eigen::Vector2d low = lattice::Lattice::corner();
  const Eigen::Vector2d high = low + lattice_of(scene).size();
  return {std::max(view.left, low.x()), std::max(view.bottom, low.y()),
          std::min(view.right, high.x()), std::min(view.top, high.y())};
}

/// The x of lines that stand for the slit, a column of sites apart; lattice spacings.
std::vector<double> slit_lines(const SpaceTimeOptions& options) {
  const int count =
      std::max(1, static_cast<int>(std::lround(options.slit / lattice::kColumnPitch)));
  std::vector<double> lines;
  for (int i = 0; i < count; ++i) {
    lines.push_back(*options.column + (i - (count - 1) / 2.0) * lattice::kColumnPitch);
  }
  return lines;
}

/// Throws RedrawError.
[[noreturn]] void refuse(const SpaceTimeOptions& options, const std::string& message) {
  throw RedrawError(fmt::format("{}: {}", options.file.string(), message));
}

void check_column(const scene::Scene& scene, const SpaceTimeOptions& options,
                  const std::vector<store::Trajectory::Frame>& frames) {
  const scene::Frames& pictures = *scene.output.frames;
  const lattice::Rectangle part = shown_part(scene);
  const double width = part.right - part.left;
  if (!(options.slit > 0 && options.slit <= width)) {
    refuse(options, fmt::format("expected a slit above 0 and up to {:g} spacings, the width of the "
                                "box in view, found {:g}",
                                width, options.slit));
  }
  const std::vector<double> lines = slit_lines(options);
  if (!(lines.front() >= part.left && lines.back() <= part.right)) {
    refuse(options,
           fmt::format("the column at x = {:g} reaches beyond the box in view, x = {:g} to {:g}",
                       *options.column, part.left, part.right));
  }
  if (pictures.color_by == scene::ColorBy::displacement && !pictures.range &&
      frames.front().stage != frames.back().stage) {
    refuse(options,
           "colours by displacement have another colour bar in each stage; give "
           "output.frames.range, or take the steps of one stage");
  }
}

/// The options, if there is such a picture.
const SpaceTimeOptions& checked(const scene::Scene& scene, const SpaceTimeOptions& options,
                                const std::vector<store::Trajectory::Frame>& frames) {
  if (options.file.extension() != ".png") {
    refuse(options, "a picture over time ends in .png");
  }
  if (frames.front().step == frames.back().step) {
    refuse(options, "a picture over time needs frames of two steps in that range");
  }
  const lattice::Rectangle part = shown_part(scene);
  if (!(part.left < part.right && part.bottom < part.top)) {
    refuse(options, "output.frames.view shows nothing of the box");
  }
  if (options.column) {
    check_column(scene, options, frames);
  }
  return options;
}

/// Metres, millimetres or micrometres for a length in lattice spacings, where the scene has units.
AxisUnit unit_for(const scene::Scene& scene, double length) {
  if (!scene.units) {
    return {.name = "lattice spacings", .spacing = 1};
  }
  const double spacing = scene.units->spacing;
  return spacing * length >= 1      ? AxisUnit{.name = "m", .spacing = spacing}
         : spacing * length >= 1e-3 ? AxisUnit{.name = "mm", .spacing = 1e3 * spacing}
                                    : AxisUnit{.name = "µm", .spacing = 1e6 * spacing};
}

/// Time of a step and the label of its axis.
render::Axis time_axis(const scene::Scene& scene, std::uint64_t from, std::uint64_t to) {
  if (const auto conversion = scene::conversion(scene)) {
    return {.label = fmt::format("time ({})", conversion->time_unit),
            .low = conversion->time(from),
            .high = conversion->time(to)};
  }
  return {.label = "step", .low = static_cast<double>(from), .high = static_cast<double>(to)};
}

render::Axis position_axis(const SpaceTimeOptions& options, const lattice::Rectangle& part,
                           const AxisUnit& unit) {
  if (!options.column) {
    return {.label = fmt::format("x ({})", unit.name),
            .low = unit.spacing * part.left,
            .high = unit.spacing * part.right};
  }
  const double x = unit.spacing * *options.column;
  const double half = unit.spacing * options.slit / 2;
  const std::string where = slit_lines(options).size() > 1
                                ? fmt::format("x = {:g} to {:g}", x - half, x + half)
                                : fmt::format("x = {:g}", x);
  return {.label = fmt::format("height at {} ({})", where, unit.name),
          .low = unit.spacing * part.bottom,
          .high = unit.spacing * part.top};
}

/// Without the legend.
render::TimePlot plot_of(const scene::Scene& scene, const render::Axis& position,
                         const std::vector<store::Trajectory::Frame>& frames) {
  const scene::Frames& pictures = *scene.output.frames;
  const std::uint64_t begin = frames.front().step;
  render::TimePlot plot = {
      .width = pictures.width.value_or(kUsualWidth),
      .height = pictures.height.value_or(kUsualHeight),
      .annotations = pictures.caption,
      .title = pictures.style == scene::PictureStyle::screen ? scene.title : "",
      .time = time_axis(scene, begin, frames.back().step),
      .position = position,
      .stages = {},
      .legend = {}};
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (i == 0 || frames[i].stage != frames[i - 1].stage) {
      plot.stages.push_back({.name = scene.stages[frames[i].stage].name,
                             .begin = time_axis(scene, begin, frames[i].step).high});
    }
  }
  return plot;
}

std::uint8_t channel(double value) {
  return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0, 255.0)));
}

}  // namespace

SpaceTime::SpaceTime(const scene::Scene& scene, const FramePainter& painter,
                     const SpaceTimeOptions& options, std::vector<store::Trajectory::Frame> frames)
    : scene_(scene),
      painter_(painter),
      options_(checked(scene, options, frames)),
      frames_(std::move(frames)),
      shown_box_(shown_part(scene)),
      unit_(unit_for(scene, options.column ? shown_box_.top - shown_box_.bottom
                                           : shown_box_.right - shown_box_.left)),
      plot_(plot_of(scene, position_axis(options, shown_box_, unit_), frames_)),
      panel_(render::time_panel(plot_)),
      means_(panel_.width, panel_.height, options.column ? 3 : 2,
             static_cast<double>(frames_.front().step), static_cast<double>(frames_.back().step)) {}

void SpaceTime::add(const View& view, const PictureHistory& history, std::size_t number) {
  const std::uint64_t next = frames_[std::min(number + 1, frames_.size() - 1)].step;
  means_.add(static_cast<double>(frames_[number].step), static_cast<double>(next),
             options_.column ? column(view, history) : surface(view.state));
}

void SpaceTime::require_writable() const {
  store::named_file(options_.file).create();
}

double SpaceTime::position(int row) const {
  const double share = (row + 0.5) / panel_.height;
  return options_.column ? shown_box_.bottom + share * (shown_box_.top - shown_box_.bottom)
                         : shown_box_.left + share * (shown_box_.right - shown_box_.left);
}

std::vector<Eigen::Vector2d> SpaceTime::line(double x, double turn) const {
  const lattice::Rectangle view = view_of(scene_);
  const Eigen::Vector2d middle((view.left + view.right) / 2, (view.bottom + view.top) / 2);
  const Eigen::Rotation2Dd back(-turn * std::numbers::pi / 180);
  std::vector<Eigen::Vector2d> points;
  for (int row = 0; row < panel_.height; ++row) {
    points.emplace_back(middle + back * (Eigen::Vector2d(x, position(row)) - middle));
  }
  return points;
}

Eigen::ArrayXXd SpaceTime::column(const View& view, const PictureHistory& history) {
  const render::Coloring coloring = painter_.coloring(view, history);
  colors_ = colors_ ? render::common_legend(*colors_, coloring.legend) : coloring.legend;
  Eigen::ArrayXXd mean = Eigen::ArrayXXd::Zero(3, panel_.height);
  const std::vector<double> lines = slit_lines(options_);
  for (const double x : lines) {
    const render::LineColors seen =
        render::line_colors(view.state, view.occupancy, coloring, line(x, painter_.turn(view)));
    walls_.standing = walls_.standing || seen.walls.standing;
    walls_.moving = walls_.moving || seen.walls.moving;
    for (int row = 0; row < panel_.height; ++row) {
      const render::Rgb color = seen.colors[static_cast<std::size_t>(row)];
      mean.col(row) += Eigen::Array3d(color.red, color.green, color.blue);
    }
  }
  return mean / static_cast<double>(lines.size());
}

Eigen::ArrayXXd SpaceTime::surface(const grains::State& state) const {
  const std::vector<double> profile = measure::surface_profile(state);
  Eigen::ArrayXXd result(2, panel_.height);
  for (int row = 0; row < panel_.height; ++row) {
    const double column = std::round(position(row) / lattice::kColumnPitch);
    const double last = static_cast<double>(profile.size()) - 1;
    const double height = profile[static_cast<std::size_t>(std::clamp(column, 0.0, last))];
    result.col(row) << height, height > 0 ? 1 : 0;
  }
  return result;
}

template <class ColorOf>
render::Image SpaceTime::content(ColorOf color_of) const {
  render::Image image(panel_.width, panel_.height, kWhite);
  for (int x = 0; x < panel_.width; ++x) {
    for (int row = 0; means_.is_known(x) && row < panel_.height; ++row) {
      image.at(x, panel_.height - 1 - row) = color_of(means_.mean(x, row));
    }
  }
  return image;
}

render::Image SpaceTime::column_content() {
  if (colors_) {
    plot_.legend = *colors_;
  }
  render::add_walls(plot_.legend, walls_);
  return content([](const Eigen::ArrayXd& mean) {
    return render::Rgb{channel(mean[0]), channel(mean[1]), channel(mean[2])};
  });
}

render::Image SpaceTime::surface_content() {
  double highest = 0;
  bool bare = false;
  for (int x = 0; x < panel_.width; ++x) {
    for (int row = 0; means_.is_known(x) && row < panel_.height; ++row) {
      const Eigen::ArrayXd mean = means_.mean(x, row);
      if (mean[1] < kBare) {
        bare = true;
      } else {
        highest = std::max(highest, mean[0] / mean[1]);
      }
    }
  }
  const AxisUnit unit = unit_for(scene_, highest);
  plot_.legend.bars = {{.label = fmt::format("height of the surface ({})", unit.name),
                        .high = unit.spacing * highest}};
  if (bare) {
    plot_.legend.patches = {{.label = "no grains", .color = kWhite}};
  }
  return content([&](const Eigen::ArrayXd& mean) {
    return mean[1] < kBare ? kWhite : render::map_color(mean[0] / mean[1] / highest);
  });
}

void SpaceTime::finish() {
  const render::Image shown = options_.column ? column_content() : surface_content();
  store::write_whole(options_.file,
                     image::encode_png(render::time_picture(plot_, shown), scene_metadata(scene_)));
}

}  // namespace clca::run
