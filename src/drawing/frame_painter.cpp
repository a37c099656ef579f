#include "drawing/internal/frame_painter.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <utility>

#include "clca/contact/force.hpp"
#include "clca/measure/mixing.hpp"
#include "clca/scene/parse.hpp"
#include "clca/scene/walls.hpp"
#include "clca/store/summary.hpp"
#include "record/internal/contact_record.hpp"

namespace clca::drawing {

namespace {

// Higher ends of colour bars: fixed, so that pictures of a sequence are comparable.
constexpr int kForceIndexBarEnd = 8;  // overlapped sites
constexpr double kLoadBarEnd = 2;     // in OverlayScales::strongest_force
constexpr double kSpeedBarEnd = 2;    // in OverlayScales::middle_speed
constexpr double kSpinBarEnd = 0.5;   // in OverlayScales::highest_spin
constexpr double kContactBarEnd = 6;  // as many as touch a disc among discs of one size

constexpr int kTileSamples = 4;  // along each axis of a pixel, as a picture made smaller has

render::Style style_of(const scene::PictureOutput& frames, const lattice::Lattice& lattice,
                       const PictureUse& use) {
  render::Style style = {
      .width = frames.width.value_or(0),
      .height = frames.height.value_or(0),
      .supersampling = frames.supersampling,
      .drawing = frames.drawing == scene::DrawingMethod::polygons ? render::DrawingMethod::polygons
                                                                  : render::DrawingMethod::lookup,
      .view = view_rectangle(frames, lattice),
      .annotations = !frames.has_caption                          ? render::Annotations::none
                     : frames.style == scene::PictureStyle::print ? render::Annotations::legend
                                                                  : render::Annotations::all,
      .threads = use.threads,
      .for_pdf = use.for_pdf};
  if (use.tile_width != 0) {
    const auto& [left, bottom, right, top] = style.view;
    const image::PixelBox size = render::tile_size(right - left, top - bottom, use.tile_width);
    style.width = size.width;
    style.height = size.height;
    style.supersampling = kTileSamples;
    style.annotations = render::Annotations::none;
  }
  return style;
}

render::Painter make_painter(const scene::Scene& scene, const grains::State& state,
                             const PictureUse& use) {
  const scene::PictureOutput& frames = *scene.output.frames;
  try {
    return {style_of(frames, state.lattice, use), state.lattice, state.kinds};
  } catch (const render::RenderError& error) {
    throw scene::SceneError(fmt::format("{}: error: {}", frames.location, error.what()));
  }
}

std::vector<render::NamedColor> species_colors(const scene::Scene& scene) {
  std::vector<render::NamedColor> colors;
  for (std::size_t number = 0; number < scene.species.size(); ++number) {
    const scene::Species& species = scene.species[number];
    const render::Rgb color = species.color.value_or(render::palette_color(number));
    colors.push_back({species.name, color});
  }
  return colors;
}

/// Speeds by id, `step_velocity` for a lattice spacing per step. Without velocities of the model:
/// of the mean velocity since the window began, 0 for particles that have come since.
std::vector<double> speeds(const PictureContent& content, const PictureHistory& history,
                           double step_velocity) {
  std::vector<double> result(content.state.particles.size(), 0);
  if (content.contact) {
    std::ranges::transform(
        content.contact->velocities, result.begin(),
        [&](const Eigen::Vector2d& velocity) { return step_velocity * velocity.norm(); });
  } else if (history.window->step() < content.state.step) {
    const auto velocities = history.window->velocities(content.state);
    std::ranges::transform(velocities, result.begin(), [&](const auto& velocity) {
      return velocity ? step_velocity * velocity->norm() : 0;
    });
  }
  return result;
}

/// Angular velocities by id, radians per unit of time. `time_step`: in that unit.
std::vector<double> spins(const PictureContent& content, double time_step) {
  std::vector<double> result = content.contact->spins;
  for (std::size_t id = 0; id < result.size(); ++id) {
    const double radius = content.state.shape(content.state.particles[id]).diameter() / 2;
    result[id] /= radius * time_step;
  }
  return result;
}

/// By id, the normal forces on each grain, or these over the circumference of a disc of its area.
std::vector<double> loads(const PictureContent& content, const OverlayScales& scales,
                          bool over_circumference) {
  const grains::State& state = content.state;
  std::vector<double> result =
      contact::normal_loads(state.particles.size(), content.contact->forces);
  const double unit =
      scales.unit_factor(over_circumference ? scene::kStressUnit : scene::kContactForceUnit, state);
  for (std::size_t id = 0; id < result.size(); ++id) {
    const double diameter = state.shape(state.particles[id]).diameter();
    result[id] *= over_circumference ? unit / (std::numbers::pi * diameter) : unit;
  }
  return result;
}

}  // namespace

PictureContent current_content(const scene::Scene& scene, const model::SceneModel& model,
                               const record::Observers& observers) {
  PictureContent content = {.state = model.state(),
                            .occupancy = model.grains().occupancy(),
                            .cycles = observers.find<record::CycleRecord>(),
                            .vessel_angle = model.vessel().angle};
  if (scene.model == scene::Model::contact) {
    content.contact.emplace();
    if (scene::pictures_show_forces(scene)) {
      content.contact->forces = observers.find<record::ContactRecord>()->shown_forces(model);
    }
    if (scene.output.frames->color_by == scene::ColorBy::speed) {
      content.contact->velocities = model.velocities();
    }
    if (scene.output.frames->color_by == scene::ColorBy::spin) {
      content.contact->spins = model.spins();
    }
  }
  return content;
}

lattice::Rectangle view_rectangle(const scene::PictureOutput& frames,
                                  const lattice::Lattice& lattice) {
  return frames.view.value_or(render::box_with_frame(lattice));
}

void begin_stage(PictureHistory& history, const scene::Scene& scene, const scene::Stage& stage,
                 const grains::State& state) {
  double highest = 2;
  for (std::size_t id = 0; id < state.particles.size(); ++id) {
    if (state.particles[id].present) {
      highest = std::max(highest, lattice::position(state.origins[id]).y());
    }
  }
  history.stage = stage.name;
  history.displacement_scale = highest / 2;
  history.layers = render::layer_range(state, stage.open_sources);
  begin_window(history, scene, state);
}

void begin_window(PictureHistory& history, const scene::Scene& scene, const grains::State& state) {
  if (scene::pictures_compare_positions(scene)) {
    history.window.emplace(state);
  }
}

image::PngText scene_metadata(const scene::Scene& scene) {
  return {{"Title", scene.title},
          {"Software", fmt::format("clca {}", store::version())},
          {"Scene", scene.name},
          {"Seed", fmt::format("{}", scene.seed)}};
}

FramePainter::FramePainter(const scene::Scene& scene, const grains::State& state,
                           const PictureUse& use)
    : scene_(scene),
      frames_(*scene.output.frames),
      scales_(overlay_scales(scene)),
      painter_(make_painter(scene, state, use)) {}

double FramePainter::bytes_for(const scene::Scene& scene, double particles, int captures) {
  return render::Painter::bytes_for(
      style_of(*scene.output.frames, scene::lattice_of(scene.box), {}), particles, captures);
}

CapturedFrame FramePainter::capture(const PictureContent& content, const PictureHistory& history) {
  const std::uint64_t step = content.state.step;
  render::Coloring colors = coloring(content, history);
  render::Overlay overlay = overlay_of(frames_.overlay, content, history, scales_);
  colors.legend.lines = overlay.legend_lines;
  image::PngText text = scene_metadata(scene_);
  text["Stage"] = history.stage;
  text["Step"] = fmt::format("{}", step);
  std::string when = fmt::format("step {}", step);
  if (scales_.conversion) {
    text["Time"] = scales_.conversion->time_text(step);
    when = "t = " + text["Time"];
  }
  return {.capture = painter_.capture(content.state, content.occupancy, colors),
          .caption = {.title = scene_.title,
                      .detail = fmt::format("{}, {}", history.stage, when),
                      .metres_per_spacing = scene_.units ? scene_.units->spacing : 0},
          .overlay = std::move(overlay),
          .turn_degrees = frames_.turns_with_vessel ? contact::to_degrees(content.vessel_angle) : 0,
          .text = std::move(text)};
}

Picture FramePainter::rasterize(const CapturedFrame& frame) {
  Picture picture = {
      .image = painter_.rasterize(frame.capture, frame.caption, frame.overlay, frame.turn_degrees),
      .moment_text = frame.caption.detail,
      .legend = frame.capture.legend,
      .text = frame.text};
  picture.legend.fade = frame.overlay.fade;
  const auto& [box, scale] = painter_.view();
  picture.text["View"] = fmt::format("{} {} {} {}", box.x, box.y, box.width, box.height);
  picture.text["Scale"] = fmt::format("{}", scale);
  if (frames_.has_caption) {
    picture.text["Legend"] = render::to_text(picture.legend);
  }
  return picture;
}

render::Tile FramePainter::tile(const Picture& picture, int width) const {
  render::Tile tile = render::tile(picture.image, painter_.view(), width);
  if (frames_.has_caption) {
    tile.legend = picture.legend;
  }
  return tile;
}

std::vector<std::uint8_t> FramePainter::pdf(const CapturedFrame& frame) {
  return painter_.pdf(frame.capture, frame.caption, frame.overlay, frame.turn_degrees);
}

render::Coloring FramePainter::coloring(const PictureContent& content,
                                        const PictureHistory& history) const {
  const grains::State& state = content.state;
  const auto range = [this](double high) {
    return frames_.color_range
               ? statistics::Range{frames_.color_range->low, frames_.color_range->high}
               : statistics::Range{0, high};
  };
  switch (frames_.color_by) {
    case scene::ColorBy::stage_layer:
      return render::color_by_layer(state, frames_.layer_count, history.layers);
    case scene::ColorBy::displacement:
      return render::color_by_displacement(state, range(history.displacement_scale));
    case scene::ColorBy::speed:
      return render::color_by_value(state, speeds(content, history, scales_.step_velocity),
                                    fmt::format("speed ({})", scales_.velocity_unit.plural),
                                    range(kSpeedBarEnd * scales_.middle_speed));
    case scene::ColorBy::spin: {
      const double high = kSpinBarEnd * scales_.highest_spin;
      const auto ends = frames_.color_range ? range(high) : statistics::Range{-high, high};
      return render::color_by_value(state, spins(content, scales_.conversion->time_step),
                                    fmt::format("spin (radians/{})", scales_.conversion->time_unit),
                                    ends, true);
    }
    case scene::ColorBy::coordination: {
      const std::vector<int> touched = measure::coordination_numbers(state, content.occupancy);
      return render::color_by_value(state, {touched.begin(), touched.end()},
                                    "grains and walls touched", range(kContactBarEnd));
    }
    case scene::ColorBy::id:
      return render::color_by_id(state);
    case scene::ColorBy::axis:
      return render::color_by_axis(state);
    case scene::ColorBy::force:
      return content.contact
                 ? render::color_by_value(
                       state, loads(content, scales_, /*over_circumference=*/false),
                       fmt::format("load ({})", scales_.picture_unit(scene::kContactForceUnit)),
                       range(kLoadBarEnd * scales_.strongest_force))
                 : render::color_by_force(state, content.occupancy, range(kForceIndexBarEnd));
    case scene::ColorBy::pressure:
      return render::color_by_value(
          state, loads(content, scales_, /*over_circumference=*/true),
          fmt::format("pressure ({})", scales_.picture_unit(scene::kStressUnit)),
          range(scales_.highest_pressure));
    case scene::ColorBy::species:
      break;
  }
  return render::color_by_species(state, species_colors(scene_));
}

}  // namespace clca::drawing
