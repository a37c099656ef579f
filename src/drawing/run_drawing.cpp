#include "drawing/run_drawing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "clca/model/initial_state.hpp"
#include "clca/scene/parse.hpp"
#include "clca/scene/units.hpp"
#include "clca/store/run_folder.hpp"
#include "clca/store/summary.hpp"
#include "clca/text/message.hpp"

namespace clca::drawing {

namespace {

namespace fs = std::filesystem;
using Frame = store::Trajectory::Frame;

// Names of scales; that of velocities is their unit.
constexpr const char* kDisplacement = "displacement";
constexpr const char* kCell = "cell";

/// The scene, if the run can be drawn.
const scene::Scene& checked_scene(const RunToDraw& run) {
  const scene::Scene& scene = run.scene;
  std::error_code unknown;
  const auto& trajectory = scene.output.trajectory;
  if (!trajectory && !fs::exists(run.run_folder / "trajectory", unknown) && !unknown) {
    throw RedrawError(fmt::format(
        "{}: the run has left no trajectory; run the scene again with output.trajectory in it, as "
        "by --set output.trajectory.every=10",
        run.run_folder.string()));
  }
  if (scene.output.frames->overlay == scene::Overlay::arrows) {
    throw RedrawError(fmt::format(
        "{}: overlay: arrows are means over whole cycles, which a trajectory does not hold; draw "
        "with another overlay",
        scene.output.frames->location));
  }
  if (scene::pictures_show_forces(scene) && !(trajectory && trajectory->has_contacts)) {
    const bool overlay = scene.output.frames->overlay == scene::Overlay::forces;
    throw RedrawError(fmt::format(
        "{}: {}: the trajectory of this run holds no forces; draw {}, or run the scene again with "
        "output.trajectory.contacts: true",
        scene.output.frames->location, overlay ? "overlay" : "color_by",
        overlay ? "with the overlay none" : "by another colour"));
  }
  return scene;
}

std::size_t nearest_frame(const std::vector<Frame>& frames, const RedrawOptions& options) {
  const auto distance = [&](const Frame& frame) {
    return frame.step < options.first_step ? options.first_step - frame.step
                                           : frame.step - std::min(frame.step, options.last_step);
  };
  return static_cast<std::size_t>(std::ranges::min_element(frames, {}, distance) - frames.begin());
}

/// Keeps only the pictures of one stage, with one of its beginning.
void keep_stage(std::vector<std::size_t>& pictures, const RunToDraw& run, const std::string& stage,
                const std::vector<Frame>& frames) {
  const std::vector<std::string_view> names = text::names_of(run.scene.stages);
  const auto number = static_cast<std::size_t>(std::ranges::find(names, stage) - names.begin());
  if (number == names.size()) {
    throw RedrawError(fmt::format("{}: no stage {}{}", run.run_folder.string(), text::quoted(stage),
                                  text::suggestion(stage, names)));
  }
  const auto first = std::ranges::find(frames, number, &Frame::stage);
  if (first == frames.end()) {
    throw RedrawError(fmt::format("{}: the trajectory ends before the stage {}",
                                  run.run_folder.string(), text::quoted(stage)));
  }
  std::erase_if(pictures, [&](std::size_t i) { return frames[i].stage != number; });
  const auto begin = static_cast<std::size_t>(first - frames.begin());
  if (pictures.empty() || pictures.front() != begin) {  // drawn as the end of the stage before
    pictures.insert(pictures.begin(), begin);
  }
}

/// The pictures of the run that the options select, or the nearest frame.
std::vector<std::size_t> chosen_pictures(const RunToDraw& run, const RedrawOptions& options,
                                         const std::vector<Frame>& frames,
                                         const std::vector<std::size_t>& run_pictures) {
  if (frames.empty()) {
    throw RedrawError(fmt::format("{}: the trajectory is empty so far", run.run_folder.string()));
  }
  if (options.first_step > options.last_step) {
    throw RedrawError(fmt::format("{}: expected a first step up to the last one, found {} and {}",
                                  run.run_folder.string(), options.first_step, options.last_step));
  }
  std::vector<std::size_t> result = run_pictures;
  if (options.only_stage) {
    keep_stage(result, run, *options.only_stage, frames);
  }
  std::erase_if(result, [&](std::size_t i) {
    return frames[i].step < options.first_step || frames[i].step > options.last_step;
  });
  const bool has_no_end = options.last_step == RedrawOptions().last_step;
  if (options.first_step > frames.back().step && has_no_end) {
    throw RedrawError(
        fmt::format("{}: no picture in that range; the trajectory goes from step {} to {}",
                    run.run_folder.string(), frames.front().step, frames.back().step));
  }
  if (result.empty() && options.only_stage) {
    throw RedrawError(fmt::format("{}: stage {} has no picture in that range",
                                  run.run_folder.string(), text::quoted(*options.only_stage)));
  }
  if (result.empty()) {
    result.push_back(nearest_frame(frames, options));
  }
  return result;
}

std::vector<contact::Vessel> vessels(const scene::Scene& scene, const std::vector<Frame>& frames) {
  std::vector<contact::Vessel> result;
  std::uint64_t start = 0;
  for (const Frame& frame : frames) {
    if (frame.stage < result.size()) {
      continue;
    }
    contact::Vessel vessel;
    if (!result.empty()) {
      vessel.angle = angle_after(result.back(), frame.step - start);
    }
    if (scene.model == scene::Model::contact) {
      vessel = vessel_at_start(scene, scene.stages[frame.stage], vessel);
    }
    result.push_back(vessel);
    start = frame.step;
  }
  return result;
}

std::string text_without_pictures(scene::Scene scene) {
  scene.title.clear();
  scene.output.frames.reset();
  scene.output.default_view.reset();
  for (scene::Species& species : scene.species) {
    species.color.reset();
  }
  return scene::to_yaml(scene);
}

}  // namespace

scene::Scene scene_for_drawing(const fs::path& folder,
                               const std::vector<scene::Override>& overrides) {
  const store::RunSummary summary = store::read_summary(folder / store::kSummaryFile);
  if (summary.kind == "boltzmann") {
    throw RedrawError(fmt::format(
        "{}: a run of the Boltzmann equation, of which there are figures only (clca plot)",
        folder.string()));
  }
  const fs::path file = folder / store::kSceneFile;
  const scene::Scene stored = scene::parse_file(file);
  std::vector<scene::Override> all = overrides;
  if (!stored.output.frames) {
    all.insert(all.begin(), "output.frames={}");
  }
  scene::Scene scene = scene::parse_file(file, all);
  if (text_without_pictures(scene) != text_without_pictures(stored) || !scene.output.frames) {
    throw RedrawError(
        "what is drawn again can differ in output.frames, title and the colour of species only; "
        "for all else, run the scene anew");
  }
  scene.name = summary.scene;
  return scene;
}

image::Image picture_of_step(RunToDraw run, std::uint64_t step, double max_bytes) {
  run.scene.output.frames->every = 1;  // each frame of the trajectory has one
  RunDrawing drawing(run, {.first_step = step, .last_step = step}, max_bytes);
  if (drawing.step_of_picture(0) != step) {
    throw RedrawError(fmt::format("{}: no frame of step {} in the trajectory; the nearest is of {}",
                                  run.run_folder.string(), step, drawing.step_of_picture(0)));
  }
  drawing.prepare_painter();
  return drawing.painter().rasterize(drawing.capture(0)).image;
}

RunDrawing::RunDrawing(const RunToDraw& run, const RedrawOptions& options, double max_bytes)
    : name_(fs::absolute(run.run_folder / "").lexically_normal().parent_path().filename().string()),
      scene_(checked_scene(run)),
      initial_(model::initial_state(scene_)),
      trajectory_(run.run_folder, scene_, initial_, max_bytes),
      run_pictures_(chosen_frames(trajectory_.frames(), scene_.output.frames->every)),
      chosen_(chosen_pictures(run, options, trajectory_.frames(), run_pictures_)),
      vessels_(vessels(scene_, trajectory_.frames())),
      pdf_(options.as_pdf) {
  const std::uint64_t first = step_of_picture(0);
  if (first < options.first_step || first > options.last_step) {
    note_ = fmt::format("{}: no picture of the steps {} to {}; step {} of the trajectory is drawn",
                        run.run_folder.string(), options.first_step, options.last_step, first);
  }
}

RunDrawing::ScaleEnds RunDrawing::scale_ends() const {
  ScaleEnds ends;
  if (scene_.output.frames->color_by == scene::ColorBy::displacement) {
    std::set<std::size_t> stages;
    for (const std::size_t frame : chosen_) {
      stages.insert(trajectory_.frames()[frame].stage);
    }
    double& end = ends[kDisplacement];
    for (const std::size_t stage : stages) {
      PictureHistory history;
      drawing::begin_stage(history, scene_, scene_.stages[stage],
                           trajectory_.state(first_frame(stage)));
      end = std::max(end, history.displacement_scale);
    }
  }
  const OverlayScales scales = overlay_scales(scene_);
  ends[scales.picture_unit(scene::kContactForceUnit)] = scales.strongest_force;
  ends[scales.velocity_unit.plural] = scales.middle_speed;
  ends[kCell] = scales.velocity_cell_size;
  return ends;
}

void RunDrawing::set_scale_ends(const ScaleEnds& ends) {
  scene::PictureOutput& frames = *scene_.output.frames;
  if (frames.color_by == scene::ColorBy::displacement && !frames.color_range) {
    frames.color_range = {0, ends.at(kDisplacement)};
  }
  const OverlayScales scales = overlay_scales(scene_);
  frames.widest_line_force = ends.at(scales.picture_unit(scene::kContactForceUnit));
  frames.longest_arrow_speed = ends.at(scales.velocity_unit.plural);
  frames.velocity_cell_side = ends.at(kCell);
}

void RunDrawing::unify_arrow_scale() {
  if (scene_.output.frames->overlay != scene::Overlay::velocity) {
    return;
  }
  OverlayScales& scales = painter_->scales();
  double highest = 0;
  for (std::size_t number = 0; number < picture_count(); ++number) {
    visit_content(number, chosen_[number], [&](const PictureContent& content) {
      highest = std::max(highest, typical_velocity(content, history_, scales));
    });
  }
  scales.arrow_velocity = arrow_velocity_for(highest, scales);
}

CapturedFrame RunDrawing::capture(std::size_t number) {
  std::optional<CapturedFrame> frame;
  visit_content(number, chosen_[number], [&](const PictureContent& content) {
    frame = painter_->capture(content, history_);
  });
  return *std::move(frame);
}

std::vector<Frame> RunDrawing::picture_frames() const {
  std::vector<Frame> result;
  for (const std::size_t frame : chosen_) {
    result.push_back(trajectory_.frames()[last_frame_of_step(frame)]);
  }
  return result;
}

void RunDrawing::add_frame_to(SpaceTimePainter& space_time, std::size_t number) {
  visit_content(number, last_frame_of_step(chosen_[number]), [&](const PictureContent& content) {
    space_time.add_frame(content, history_, number);
  });
}

std::uint64_t RunDrawing::step_of_picture(std::size_t number) const {
  return trajectory_.frames()[chosen_[number]].step;
}

template <class Show>
void RunDrawing::visit_content(std::size_t number, std::size_t frame, Show show) {
  begin_stage(trajectory_.frames()[chosen_[number]].stage);
  begin_window(chosen_[number]);
  begin_stage(trajectory_.frames()[frame].stage);
  const grains::State state = trajectory_.state(frame);
  const grains::Occupancy occupancy(state);
  std::optional<store::ContactFrame> contact;
  const scene::ColorBy colors = scene_.output.frames->color_by;
  if (scene_.model == scene::Model::contact &&
      (scene::pictures_show_forces(scene_) || colors == scene::ColorBy::speed ||
       colors == scene::ColorBy::spin)) {
    contact = trajectory_.contact_frame(frame);
    const std::vector<double>& spins = contact->spins;
    if (colors == scene::ColorBy::spin &&
        std::ranges::any_of(spins, [](double spin) { return std::isnan(spin); })) {
      throw RedrawError(
          fmt::format("{}: color_by: the trajectory is of an earlier version and holds no spins",
                      scene_.output.frames->location));
    }
  }
  show({.state = state,
        .occupancy = occupancy,
        .contact = std::move(contact),
        .vessel_angle = angle_after(vessels_[*stage_], state.step - stage_start_)});
}

std::size_t RunDrawing::first_frame(std::size_t stage) const {
  const std::vector<Frame>& frames = trajectory_.frames();
  return static_cast<std::size_t>(std::ranges::find(frames, stage, &Frame::stage) - frames.begin());
}

std::size_t RunDrawing::last_frame_of_step(std::size_t frame) const {
  const std::vector<Frame>& frames = trajectory_.frames();
  while (frame + 1 < frames.size() && frames[frame + 1].step == frames[frame].step) {
    ++frame;
  }
  return frame;
}

void RunDrawing::begin_stage(std::size_t stage) {
  if (stage_ == stage) {
    return;
  }
  stage_ = stage;
  const std::size_t first = first_frame(stage);
  stage_start_ = trajectory_.frames()[first].step;
  drawing::begin_stage(history_, scene_, scene_.stages[stage], trajectory_.state(first));
}

void RunDrawing::begin_window(std::size_t frame) {
  if (!scene::pictures_compare_positions(scene_)) {
    return;
  }
  std::size_t before = first_frame(trajectory_.frames()[frame].stage);
  const auto next = std::lower_bound(run_pictures_.begin(), run_pictures_.end(), frame);
  if (next != run_pictures_.begin()) {
    before = std::max(before, *std::prev(next));
  }
  drawing::begin_window(history_, scene_, trajectory_.state(before));
}

std::vector<std::size_t> chosen_frames(const std::vector<store::Trajectory::Frame>& frames,
                                       std::uint64_t every) {
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const store::Trajectory::Frame& frame = frames[i];
    const bool begins = i == 0 || frames[i - 1].stage != frame.stage;
    const bool ends = i + 1 == frames.size() || frames[i + 1].stage != frame.stage;
    const bool drawn_before = i > 0 && frames[i - 1].step == frame.step;
    if (!drawn_before && (begins || ends || frame.step - frames[chosen.back()].step >= every)) {
      chosen.push_back(i);
    }
  }
  return chosen;
}

bool is_evenly_chosen(std::size_t number, std::size_t count, std::size_t most) {
  if (count <= most) {
    return true;
  }
  // The k-th selected item is the one nearest to k * (count - 1) / (most - 1).
  const std::size_t gaps = most - 1;
  const std::size_t k = (number * gaps + (count - 1) / 2) / (count - 1);
  return (k * (count - 1) + gaps / 2) / gaps == number;
}

}  // namespace clca::drawing
