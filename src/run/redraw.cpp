#include "clca/run/redraw.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "clca/run/setup.hpp"
#include "clca/scene/contact.hpp"
#include "clca/store/trajectory.hpp"
#include "run/contact_record.hpp"
#include "run/frame_choice.hpp"
#include "run/frame_painter.hpp"
#include "run/meter.hpp"
#include "run/overlay_scales.hpp"
#include "run/picture_targets.hpp"
#include "run/space_time.hpp"

namespace clca::run {

namespace {

namespace fs = std::filesystem;
using Frame = store::Trajectory::Frame;

void require_different(const char* one, const fs::path& file, const char* other,
                       const fs::path& other_file) {
  const auto place = [](const fs::path& name) { return fs::absolute(name).lexically_normal(); };
  if (!file.empty() && !other_file.empty() && place(file) == place(other_file)) {
    throw RedrawError(fmt::format("{}: is to be both {} and {}", file.string(), one, other));
  }
}

/// The scene, if the run can be drawn.
const scene::Scene& drawable(const scene::Scene& scene, const RedrawOptions& options) {
  std::error_code unknown;
  if (!fs::exists(options.run / "trajectory", unknown) && !unknown) {
    throw RedrawError(fmt::format(
        "{}: the run has left no trajectory; run the scene again with output.trajectory in it, as "
        "by --set output.trajectory.every=10",
        options.run.string()));
  }
  if (scene.output.frames->overlay == scene::Overlay::arrows) {
    throw RedrawError(fmt::format(
        "{}: overlay: arrows are means over whole cycles, which a trajectory does not hold; draw "
        "with the overlay none, forces or velocity",
        scene.output.frames->location));
  }
  const auto& trajectory = scene.output.trajectory;
  if (pictures_show_forces(scene) && !(trajectory && trajectory->contacts)) {
    const bool overlay = scene.output.frames->overlay == scene::Overlay::forces;
    throw RedrawError(fmt::format(
        "{}: {}: the trajectory of this run holds no forces; draw {}, or run the scene again with "
        "output.trajectory.contacts: true",
        scene.output.frames->location, overlay ? "overlay" : "color_by",
        overlay ? "with the overlay none" : "by another colour"));
  }
  require_different("movie", options.movie, "contact sheet", options.sheet);
  if (options.space_time) {
    require_different("movie", options.movie, "picture over time", options.space_time->file);
    require_different("contact sheet", options.sheet, "picture over time",
                      options.space_time->file);
  }
  return scene;
}

/// The frames selected by scene and options.
std::vector<std::size_t> chosen(const scene::Scene& scene, const RedrawOptions& options,
                                const std::vector<Frame>& frames) {
  if (frames.empty()) {
    throw RedrawError(fmt::format("{}: the trajectory is empty so far", options.run.string()));
  }
  std::vector<std::size_t> result = frame_choice(frames, scene.output.frames->every);
  std::erase_if(result, [&](std::size_t i) {
    return frames[i].step < options.from || frames[i].step > options.to;
  });
  if (result.empty()) {
    throw RedrawError(
        fmt::format("{}: no frame to draw in that range; the {} frames of the "
                    "trajectory go from step {} to {}",
                    options.run.string(), frames.size(), frames.front().step, frames.back().step));
  }
  return result;
}

/// The vessel at the start of each stage, as follows from the scene.
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
      vessel = vessel_in(scene, scene.stages[frame.stage], vessel);
    }
    result.push_back(vessel);
    start = frame.step;
  }
  return result;
}

}  // namespace

class Redraw::Impl {
 public:
  Impl(const scene::Scene& scene, const RedrawOptions& options);

  std::size_t draw(const RedrawEvents& events);
  std::size_t pictures() const { return chosen_.size(); }

 private:
  void begin_stage(std::size_t stage);
  /// Begins the window of velocities with the picture before, drawn or not, as the run does.
  void begin_window(std::size_t place);
  std::size_t first_frame(std::size_t stage) const;
  /// The last frame of the same step: where a stage ends, that at the beginning of the next.
  std::size_t latest(std::size_t place) const;
  void draw_frame(std::size_t number);
  void add_to_space_time(std::size_t number);
  /// Calls `show` with the view of a frame.
  template <class Show>
  void look_at(std::size_t place, Show show);
  bool stop_asked() const { return options_.stop != nullptr && options_.stop->load() != 0; }

  const scene::Scene scene_;
  const RedrawOptions options_;
  store::Trajectory trajectory_;
  const std::vector<std::size_t> chosen_;  // frames
  FramePainter painter_;
  std::optional<PictureTargets> targets_;  // once drawing begins
  std::optional<std::size_t> stage_;
  std::uint64_t stage_start_ = 0;         // step
  std::vector<contact::Vessel> vessels_;  // by stage, at its start
  PictureHistory history_;
  std::optional<SpaceTime> space_time_;
};

Redraw::Impl::Impl(const scene::Scene& scene, const RedrawOptions& options)
    : scene_(drawable(scene, options)),
      options_(options),
      trajectory_(options.run, scene_, initial_state(scene_), options.max_bytes),
      chosen_(chosen(scene_, options, trajectory_.frames())),
      painter_(scene_, initial_state(scene_), 1),
      vessels_(vessels(scene_, trajectory_.frames())) {
  if (options.space_time) {
    std::vector<Frame> frames;
    for (const std::size_t place : chosen_) {
      frames.push_back(trajectory_.frames()[latest(place)]);
    }
    space_time_.emplace(scene_, painter_, *options.space_time, std::move(frames));
  }
}

std::size_t Redraw::Impl::draw(const RedrawEvents& events) {
  if (events.warning && scene_.output.frames->caption && !render::font_problem().empty()) {
    events.warning(render::font_problem());
  }
  targets_.emplace(scene_, painter_, options_, chosen_.size(),
                   trajectory_.frames()[chosen_.front()].step);
  if (space_time_) {
    space_time_->require_writable();
  }
  IntervalTimer timer(events.progress_interval);
  TimeEstimate estimate;
  std::size_t number = 0;
  for (; number < chosen_.size() && !stop_asked(); ++number) {
    if (targets_->want(number)) {
      draw_frame(number);
    }
    if (space_time_) {
      add_to_space_time(number);
    }
    if (events.progress && timer.due()) {
      estimate.update(static_cast<double>(number + 1) / static_cast<double>(chosen_.size()));
      events.progress({number + 1, chosen_.size(), estimate.seconds_left()});
    }
  }
  if (number > 0) {
    targets_->finish();
  }
  if (number > 0 && space_time_) {
    space_time_->finish();
  }
  return number;
}

void Redraw::Impl::draw_frame(std::size_t number) {
  const std::size_t place = chosen_[number];
  look_at(place, [&](const View& view) {
    targets_->add(painter_.rasterize(painter_.capture(view, history_)), number, view.state.step);
  });
}

void Redraw::Impl::add_to_space_time(std::size_t number) {
  look_at(latest(chosen_[number]),
          [&](const View& view) { space_time_->add(view, history_, number); });
}

std::size_t Redraw::Impl::latest(std::size_t place) const {
  const std::vector<Frame>& frames = trajectory_.frames();
  while (place + 1 < frames.size() && frames[place + 1].step == frames[place].step) {
    ++place;
  }
  return place;
}

template <class Show>
void Redraw::Impl::look_at(std::size_t place, Show show) {
  begin_stage(trajectory_.frames()[place].stage);
  if (shows_velocities(scene_)) {
    begin_window(place);
  }
  const grains::State state = trajectory_.state(place);
  const grains::Occupancy occupancy(state);
  const bool has_forces = pictures_show_forces(scene_);
  const std::vector<contact::Force> forces =
      has_forces ? trajectory_.contact_frame(place).forces : std::vector<contact::Force>();
  const View view = {.state = state,
                     .occupancy = occupancy,
                     .forces = has_forces ? &forces : nullptr,
                     .angle = angle_after(vessels_[*stage_], state.step - stage_start_)};
  show(view);
}

void Redraw::Impl::begin_stage(std::size_t stage) {
  if (stage_ == stage) {
    return;
  }
  stage_ = stage;
  const std::size_t first = first_frame(stage);
  stage_start_ = trajectory_.frames()[first].step;
  run::begin_stage(history_, scene_, scene_.stages[stage], trajectory_.state(first));
}

void Redraw::Impl::begin_window(std::size_t place) {
  const std::vector<Frame>& frames = trajectory_.frames();
  std::size_t before = first_frame(frames[place].stage);
  for (const std::size_t picture : frame_choice(frames, scene_.output.frames->every)) {
    if (picture < place) {
      before = std::max(before, picture);
    }
  }
  run::begin_window(history_, scene_, trajectory_.state(before));
}

std::size_t Redraw::Impl::first_frame(std::size_t stage) const {
  const std::vector<Frame>& frames = trajectory_.frames();
  const auto first = std::find_if(frames.begin(), frames.end(),
                                  [&](const Frame& frame) { return frame.stage == stage; });
  return static_cast<std::size_t>(std::distance(frames.begin(), first));
}

Redraw::Redraw(const scene::Scene& scene, const RedrawOptions& options)
    : impl_(std::make_unique<Impl>(scene, options)) {}

Redraw::~Redraw() = default;

std::size_t Redraw::draw(const RedrawEvents& events) {
  return impl_->draw(events);
}

std::size_t Redraw::pictures() const {
  return impl_->pictures();
}

}  // namespace clca::run
