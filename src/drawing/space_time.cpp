#include "drawing/space_time.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "clca/measure/profile.hpp"
#include "clca/render/painter.hpp"
#include "clca/scene/walls.hpp"

namespace clca::drawing {

namespace {

// Pixels, where the scene gives none.
constexpr int kUsualWidth = 1280;
constexpr int kUsualHeight = 720;

constexpr render::Rgb kWhite = {255, 255, 255};
constexpr double kBare = 0.5;  // share of the time with grains below which there is no surface

/// The part of the view in which there may be grains: that in the box, unless the picture is
/// turned.
lattice::Rectangle shown_part(const scene::Scene& scene) {
  const lattice::Lattice lattice = scene::lattice_of(scene.box);
  const lattice::Rectangle view = view_rectangle(*scene.output.frames, lattice);
  if (scene.output.frames->turns_with_vessel) {
    return view;
  }
  const Eigen::Vector2d low = lattice::Lattice::lower_left_corner();
  const Eigen::Vector2d high = low + lattice.extent();
  return {std::max(view.left, low.x()), std::max(view.bottom, low.y()),
          std::min(view.right, high.x()), std::min(view.top, high.y())};
}

[[noreturn]] void refuse(const SpaceTimeOptions& options, const std::string& message) {
  throw RedrawError(fmt::format("{}: {}", options.file.string(), message));
}

void check_column(const scene::Scene& scene, const SpaceTimeOptions& options,
                  const std::vector<store::Trajectory::Frame>& frames) {
  const scene::PictureOutput& pictures = *scene.output.frames;
  const lattice::Rectangle part = shown_part(scene);
  const double width = part.right - part.left;
  if (!(options.slit_width > 0 && options.slit_width <= width)) {
    refuse(options, fmt::format("expected a slit above 0 and up to {:g} spacings, the width of the "
                                "box in view, found {:g}",
                                width, options.slit_width));
  }
  // Half a column of sites may be cut off.
  const double reach = std::max(0.0, (options.slit_width - SpaceTimeOptions().slit_width) / 2);
  if (!(*options.column_x - reach >= part.left && *options.column_x + reach <= part.right)) {
    refuse(options,
           fmt::format("the column at x = {:g} reaches beyond the box in view, x = {:g} to {:g}",
                       *options.column_x, part.left, part.right));
  }
  if (pictures.color_by == scene::ColorBy::displacement && !pictures.color_range &&
      frames.front().stage != frames.back().stage) {
    refuse(options,
           "colours by displacement have another colour bar in each stage; give "
           "output.frames.range, or take the steps of one stage");
  }
}

const SpaceTimeOptions& checked(const scene::Scene& scene, const SpaceTimeOptions& options,
                                const std::vector<store::Trajectory::Frame>& frames) {
  if (options.file.extension() != ".png") {
    refuse(options, "a picture over time ends in .png");
  }
  if (frames.front().step == frames.back().step) {
    refuse(options, "a picture over time needs frames of two steps in that range");
  }
  if (options.column_x) {
    check_column(scene, options, frames);
  }
  return options;
}

/// The unit of an axis or colour bar of lengths up to `length`, and a spacing in this unit.
std::pair<std::string, double> unit_for(const scene::Scene& scene, double length) {
  if (!scene.units) {
    return {"lattice spacings", 1};
  }
  const double spacing = scene.units->spacing;
  const render::LengthUnit unit = render::length_unit(spacing * length);
  return {unit.name, unit.per_metre * spacing};
}

/// An axis as _space_time.py reads it: its label, with the unit, and its ends.
nlohmann::json axis(const std::string& label, double low, double high) {
  return {{"label", label}, {"low", low}, {"high", high}};
}

nlohmann::json time_axis(const scene::Scene& scene, std::uint64_t from, std::uint64_t to) {
  if (const auto conversion = scene::unit_conversion(scene)) {
    return axis(fmt::format("time ({})", conversion->time_unit), conversion->time(from),
                conversion->time(to));
  }
  return axis("step", static_cast<double>(from), static_cast<double>(to));
}

nlohmann::json position_axis(const scene::Scene& scene, const SpaceTimeOptions& options,
                             const lattice::Rectangle& part) {
  if (!options.column_x) {
    const auto [unit, spacing] = unit_for(scene, part.right - part.left);
    return axis(fmt::format("x ({})", unit), spacing * part.left, spacing * part.right);
  }
  const auto [unit, spacing] = unit_for(scene, part.top - part.bottom);
  const double x = spacing * *options.column_x;
  const double half = spacing * options.slit_width / 2;
  const std::string where = options.slit_width > SpaceTimeOptions().slit_width
                                ? fmt::format("x = {:g} to {:g}", x - half, x + half)
                                : fmt::format("x = {:g}", x);
  return axis(fmt::format("height at {} ({})", where, unit), spacing * part.bottom,
              spacing * part.top);
}

/// The scene with pictures of the particles alone: of the slit or, where they may be turned, of the
/// whole view.
scene::Scene scene_of_slit(scene::Scene scene, const SpaceTimeOptions& options,
                           const lattice::Rectangle& part) {
  scene::PictureOutput& frames = *scene.output.frames;
  frames.has_caption = false;
  frames.overlay = scene::Overlay::none;
  frames.height = frames.height.value_or(kUsualHeight);
  frames.width.reset();
  frames.view = part;
  if (options.column_x && !frames.turns_with_vessel) {
    frames.view->left = std::max(part.left, *options.column_x - options.slit_width / 2);
    frames.view->right = std::min(part.right, *options.column_x + options.slit_width / 2);
    const double scale = *frames.height / (part.top - part.bottom);
    frames.width = static_cast<int>(std::ceil(scale * (frames.view->right - frames.view->left)));
  }
  return scene;
}

/// The columns of the lattice whose middle is in the part of the plane.
std::pair<int, int> columns_in(const scene::Scene& scene, const lattice::Rectangle& part) {
  const int last = scene::lattice_of(scene.box).columns() - 1;
  const auto nearest = [&](double x) {
    return std::clamp(static_cast<int>(std::lround(x / lattice::kColumnPitch)), 0, last);
  };
  return {nearest(part.left), nearest(part.right)};
}

int rows_of(const scene::Scene& scene, const SpaceTimeOptions& options,
            const lattice::Rectangle& part, int pixels) {
  const auto [first, last] = columns_in(scene, part);
  return options.column_x ? pixels : last - first + 1;
}

std::uint8_t channel(double value) {
  return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0, 255.0)));
}

}  // namespace

TimeMeans::TimeMeans(int width, int height, int values, double begin, double end)
    : rows_(height),
      begin_(begin),
      columns_per_time_(width / (end - begin)),
      sums_(Eigen::ArrayXXd::Zero(values, Eigen::Index{width} * height)),
      weights_(Eigen::ArrayXd::Zero(width)) {}

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

SpaceTimePainter::SpaceTimePainter(const scene::Scene& scene, const grains::State& initial,
                                   const SpaceTimeOptions& options,
                                   std::vector<store::Trajectory::Frame> frames)
    : options_(checked(scene, options, frames)),
      frames_(std::move(frames)),
      shown_part_(shown_part(scene)),
      annotations_(scene.output.frames->has_caption),
      scene_(scene_of_slit(scene, options_, shown_part_)),
      painter_(scene_, initial, {}),
      means_(scene.output.frames->width.value_or(kUsualWidth),
             rows_of(scene, options_, shown_part_, painter_.height()), options_.column_x ? 3 : 2,
             static_cast<double>(frames_.front().step), static_cast<double>(frames_.back().step)) {}

void SpaceTimePainter::add_frame(const PictureContent& content, const PictureHistory& history,
                                 std::size_t number) {
  const std::uint64_t next = frames_[std::min(number + 1, frames_.size() - 1)].step;
  means_.add(static_cast<double>(frames_[number].step), static_cast<double>(next),
             options_.column_x ? slit_colors(content, history) : surface_heights(content.state));
}

Eigen::ArrayXXd SpaceTimePainter::slit_colors(const PictureContent& content,
                                              const PictureHistory& history) {
  const Picture picture = painter_.rasterize(painter_.capture(content, history));
  legend_ = legend_ ? render::common_legend(*legend_, picture.legend) : picture.legend;
  const lattice::Rectangle& seen = *scene_.output.frames->view;
  const image::PixelBox& box = painter_.view_box();
  const auto pixel = [&](double x) {
    return static_cast<int>(std::lround((x - seen.left) / (seen.right - seen.left) * box.width));
  };
  const int left =
      std::clamp(pixel(*options_.column_x - options_.slit_width / 2), 0, box.width - 1);
  const int right =
      std::clamp(pixel(*options_.column_x + options_.slit_width / 2), left + 1, box.width);
  Eigen::ArrayXXd mean = Eigen::ArrayXXd::Zero(3, means_.height());
  for (int row = 0; row < means_.height(); ++row) {
    const int y = box.y + box.height - 1 - row * box.height / means_.height();
    for (int x = left; x < right; ++x) {
      const render::Rgb color = picture.image.at(box.x + x, y);
      mean.col(row) += Eigen::Array3d(color.red, color.green, color.blue);
    }
  }
  return mean / (right - left);
}

Eigen::ArrayXXd SpaceTimePainter::surface_heights(const grains::State& state) const {
  const std::vector<double> profile = measure::surface_profile(state);
  const auto first = static_cast<std::size_t>(columns_in(scene_, shown_part_).first);
  Eigen::ArrayXXd result(2, means_.height());
  for (int row = 0; row < means_.height(); ++row) {
    const double height = profile[first + static_cast<std::size_t>(row)];
    result.col(row) << height, height > 0 ? 1 : 0;
  }
  return result;
}

template <class ColorOf>
image::Image SpaceTimePainter::image_of_means(ColorOf color_of) const {
  image::Image image(means_.width(), means_.height(), kWhite);
  for (int x = 0; x < image.width; ++x) {
    for (int row = 0; means_.is_known(x) && row < image.height; ++row) {
      image.at(x, image.height - 1 - row) = color_of(means_.mean(x, row));
    }
  }
  return image;
}

image::Image SpaceTimePainter::surface_image(render::Legend& legend) const {
  double highest = 0;
  bool bare = false;
  for (int x = 0; x < means_.width(); ++x) {
    for (int row = 0; means_.is_known(x) && row < means_.height(); ++row) {
      const Eigen::ArrayXd mean = means_.mean(x, row);
      if (mean[1] < kBare) {
        bare = true;
      } else {
        highest = std::max(highest, mean[0] / mean[1]);
      }
    }
  }
  const auto [unit, spacing] = unit_for(scene_, highest);
  legend.bars = {
      {.label = fmt::format("height of the surface ({})", unit), .high = spacing * highest}};
  if (bare) {
    legend.patches = {{.label = "no grains", .color = kWhite}};
  }
  return image_of_means([&](const Eigen::ArrayXd& mean) {
    return mean[1] < kBare ? kWhite : render::viridis_color(mean[0] / mean[1] / highest);
  });
}

SpaceTimePicture SpaceTimePainter::picture() {
  SpaceTimePicture picture;
  render::Legend legend;
  if (options_.column_x) {
    legend = legend_.value_or(render::Legend());
    picture.plot_image = image_of_means([](const Eigen::ArrayXd& mean) {
      return render::Rgb{channel(mean[0]), channel(mean[1]), channel(mean[2])};
    });
  } else {
    picture.plot_image = surface_image(legend);
  }
  const std::uint64_t begin = frames_.front().step;
  nlohmann::json stages;
  for (std::size_t i = 0; i < frames_.size(); ++i) {
    if (i == 0 || frames_[i].stage != frames_[i - 1].stage) {
      stages.push_back({{"name", scene_.stages[frames_[i].stage].name},
                        {"begin", time_axis(scene_, begin, frames_[i].step).at("high")}});
    }
  }
  const scene::PictureOutput& frames = *scene_.output.frames;
  picture.figure_json =
      nlohmann::json({{"width", means_.width()},
                      {"height", *frames.height},
                      {"annotations", annotations_},
                      {"title", frames.style == scene::PictureStyle::screen ? scene_.title : ""},
                      {"time", time_axis(scene_, begin, frames_.back().step)},
                      {"position", position_axis(scene_, options_, shown_part_)},
                      {"stages", stages},
                      {"legend", nlohmann::json::parse(render::to_text(legend))},
                      {"text", scene_metadata(scene_)}})
          .dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
  return picture;
}

}  // namespace clca::drawing
