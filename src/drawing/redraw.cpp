#include "clca/drawing/redraw.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "clca/scene/resolve.hpp"
#include "clca/scene/units.hpp"
#include "clca/store/run_folder.hpp"
#include "clca/store/summary.hpp"
#include "drawing/picture_targets.hpp"
#include "drawing/run_drawing.hpp"
#include "drawing/space_time.hpp"
#include "record/internal/meter.hpp"

namespace clca::drawing {

namespace {

namespace fs = std::filesystem;
using Drawings = std::vector<std::unique_ptr<RunDrawing>>;

void require_different(const char* one, const fs::path& file, const char* other,
                       const fs::path& other_file) {
  const auto full_path = [](const fs::path& name) { return fs::absolute(name).lexically_normal(); };
  if (!file.empty() && !other_file.empty() && full_path(file) == full_path(other_file)) {
    throw RedrawError(fmt::format("{}: is to be both {} and {}", file.string(), one, other));
  }
}

void check_files(const RedrawOptions& options) {
  require_different("movie", options.movie, "contact sheet", options.sheet);
  if (options.space_time) {
    const fs::path& over_time = options.space_time->file;
    require_different("movie", options.movie, "picture over time", over_time);
    require_different("contact sheet", options.sheet, "picture over time", over_time);
  }
}

/// The same scales and distinct titles, so that they can be compared.
void make_comparable(const std::vector<RunToDraw>& runs, const Drawings& drawings) {
  RunDrawing::Scale common;
  for (const auto& drawing : drawings) {
    for (const auto& [name, end] : drawing->scale()) {
      double& largest = common[name];
      largest = std::max(largest, end);
    }
  }
  for (std::size_t i = 0; i < drawings.size(); ++i) {
    drawings[i]->set_scale(common);
    drawings[i]->set_title(fmt::format("{}: {}", drawings[i]->name(), runs[i].scene.title));
  }
}

/// Times or steps of the pictures of each run.
std::vector<std::vector<double>> times_of(const Drawings& drawings) {
  const bool in_time =
      drawings.size() > 1 && std::all_of(drawings.begin(), drawings.end(), [](const auto& drawing) {
        return scene::conversion(drawing->scene()).has_value();
      });
  std::vector<std::vector<double>> result;
  for (const auto& drawing : drawings) {
    const auto conversion = scene::conversion(drawing->scene());
    std::vector<double>& times = result.emplace_back();
    for (std::size_t number = 0; number < drawing->pictures(); ++number) {
      const std::uint64_t step = drawing->step(number);
      times.push_back(in_time ? conversion->time(step) : static_cast<double>(step));
    }
  }
  return result;
}

/// All times, ascending, those that differ by rounding as one. Steps are whole numbers below 2^53.
std::vector<double> moments_of(const std::vector<std::vector<double>>& times) {
  std::vector<double> all;
  for (const std::vector<double>& some : times) {
    all.insert(all.end(), some.begin(), some.end());
  }
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end(),
                        [](double one, double next) { return next - one <= 1e-15 * next; }),
            all.end());
  return all;
}

/// How many pictures per second a movie has that is `moments` long: as wanted, or less if they have
/// to last longer.
double picture_rate(const RedrawOptions& options, std::size_t moments) {
  const auto most = static_cast<double>(options.frames_per_second);
  return options.duration ? std::min(most, static_cast<double>(moments) / *options.duration) : most;
}

/// Those that a movie as long as wanted shows.
void choose_evenly(std::vector<double>& moments, const RedrawOptions& options) {
  if (!options.duration) {
    return;
  }
  const auto most = static_cast<std::size_t>(std::max(
      2.0, std::floor(*options.duration * static_cast<double>(options.frames_per_second))));
  std::size_t number = 0;
  std::erase_if(moments, [&, count = moments.size()](double /*moment*/) {
    return !is_among(number++, count, most);
  });
}

/// The text of the scene without the keys that only affect pictures.
std::string unpainted(scene::Scene scene) {
  scene.title.clear();
  scene.output.frames.reset();
  scene.output.view.reset();
  for (scene::Species& species : scene.species) {
    species.color.reset();
  }
  return scene::to_yaml(scene);
}

}  // namespace

scene::Scene drawn_scene(const fs::path& folder, const std::vector<scene::Override>& overrides) {
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
  if (unpainted(scene) != unpainted(stored) || !scene.output.frames) {
    throw RedrawError(
        "what is drawn again can differ in output.frames, title and the colour of species only; "
        "for all else, run the scene anew");
  }
  scene.name = summary.scene;
  return scene;
}

image::Image picture(RunToDraw run, std::uint64_t step, double max_bytes) {
  run.scene.output.frames->every = 1;  // each frame of the trajectory has one
  RunDrawing drawing(run, {.from = step, .to = step}, max_bytes);
  if (drawing.step(0) != step) {
    throw RedrawError(fmt::format("{}: no frame of step {} in the trajectory; the nearest is of {}",
                                  run.folder.string(), step, drawing.step(0)));
  }
  drawing.prepare();
  return drawing.painter().rasterize(drawing.capture(0)).image;
}

class Redraw::Impl {
 public:
  Impl(const std::vector<RunToDraw>& runs, const RedrawOptions& options);

  std::size_t draw(const RedrawEvents& events);
  std::size_t moments() const { return moments_.size(); }
  TimePicture over_time() { return space_time_->picture(); }

 private:
  /// By run, that nearest to a moment.
  std::vector<std::size_t> pictures_at(double moment) const;
  /// Adds the pictures before this one to the picture over time, also those that no movie shows.
  void add_over_time(std::size_t end);
  bool stop_asked() const { return options_.stop != nullptr && options_.stop->load() != 0; }

  RedrawOptions options_;
  std::vector<std::optional<store::OutputFolder>> folders_;  // by run
  Drawings drawings_;
  std::vector<std::vector<double>> times_;  // by run, of its pictures
  std::vector<double> moments_;
  std::optional<SpaceTime> space_time_;
  std::size_t over_time_ = 0;              // pictures that it has
  std::optional<PictureTargets> targets_;  // once drawing begins
};

Redraw::Impl::Impl(const std::vector<RunToDraw>& runs, const RedrawOptions& options)
    : options_(options) {
  check_files(options);
  if (runs.size() > 1) {
    options_.columns = static_cast<int>(runs.size());
  }
  if (options.space_time && runs.size() > 1) {
    throw RedrawError(
        fmt::format("{}: a picture over time is of one run", options.space_time->file.string()));
  }
  for (const RunToDraw& run : runs) {
    folders_.push_back(run.pictures);
    drawings_.push_back(std::make_unique<RunDrawing>(
        run, options, options.max_bytes / static_cast<double>(runs.size())));
  }
  if (runs.size() > 1) {
    make_comparable(runs, drawings_);
  }
  const bool only_sheet =
      !options.sheet.empty() && options.movie.empty() &&
      std::none_of(runs.begin(), runs.end(), [](const RunToDraw& run) { return run.pictures; });
  const int tile_width = only_sheet ? render::cell_width(options_.columns) : 0;
  for (const auto& drawing : drawings_) {
    drawing->prepare(tile_width);
  }
  times_ = times_of(drawings_);
  moments_ = moments_of(times_);
  choose_evenly(moments_, options_);
  if (options.space_time) {
    RunDrawing& drawing = *drawings_.front();
    space_time_.emplace(drawing.scene(), drawing.initial(), *options.space_time,
                        drawing.latest_frames());
  }
}

std::size_t Redraw::Impl::draw(const RedrawEvents& events) {
  const bool captions = std::any_of(drawings_.begin(), drawings_.end(), [](const auto& drawing) {
    return drawing->scene().output.frames->caption;
  });
  if (events.warning && captions && !render::font_problem().empty()) {
    events.warning(render::font_problem());
  }
  if (events.warning) {
    for (const auto& drawing : drawings_) {
      if (!drawing->note().empty()) {
        events.warning(drawing->note());
      }
    }
  }
  if (!options_.movie.empty() || !options_.sheet.empty()) {
    for (const auto& drawing : drawings_) {
      drawing->share_arrow_scale();
    }
  }
  targets_.emplace(drawings_, folders_, options_, moments_.size(),
                   picture_rate(options_, moments_.size()));
  if (space_time_) {
    space_time_->require_writable();
  }
  record::IntervalTimer timer(events.progress_interval);
  record::TimeEstimate estimate;
  std::size_t number = 0;
  for (; number < moments_.size() && !stop_asked(); ++number) {
    const std::vector<std::size_t> pictures = pictures_at(moments_[number]);
    add_over_time(pictures.front());
    if (targets_->want(number)) {
      targets_->add(number, pictures);
    }
    add_over_time(pictures.front() + 1);
    if (events.progress && timer.due()) {
      estimate.update(static_cast<double>(number + 1) / static_cast<double>(moments_.size()));
      events.progress({number + 1, moments_.size(), estimate.seconds_left()});
    }
  }
  if (number > 0) {
    targets_->finish();
  }
  return number;
}

std::vector<std::size_t> Redraw::Impl::pictures_at(double moment) const {
  std::vector<std::size_t> result;
  for (const std::vector<double>& times : times_) {
    const auto nearest =
        std::min_element(times.begin(), times.end(), [&](double one, double other) {
          return std::abs(one - moment) < std::abs(other - moment);
        });
    result.push_back(static_cast<std::size_t>(nearest - times.begin()));
  }
  return result;
}

void Redraw::Impl::add_over_time(std::size_t end) {
  for (; space_time_ && over_time_ < end; ++over_time_) {
    drawings_.front()->add_to(*space_time_, over_time_);
  }
}

Redraw::Redraw(const std::vector<RunToDraw>& runs, const RedrawOptions& options)
    : impl_(std::make_unique<Impl>(runs, options)) {}

Redraw::~Redraw() = default;

std::size_t Redraw::draw(const RedrawEvents& events) {
  return impl_->draw(events);
}

std::size_t Redraw::moments() const {
  return impl_->moments();
}

TimePicture Redraw::over_time() {
  return impl_->over_time();
}

}  // namespace clca::drawing
