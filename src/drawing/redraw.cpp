#include "clca/drawing/redraw.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <span>
#include <utility>

#include "clca/render/contact_sheet.hpp"
#include "clca/render/movie.hpp"
#include "clca/scene/units.hpp"
#include "clca/store/file.hpp"
#include "clca/store/run_folder.hpp"
#include "clca/tasks/background.hpp"
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
  require_different("movie", options.movie_file, "contact sheet", options.sheet_file);
  if (options.space_time) {
    const fs::path& space_time = options.space_time->file;
    require_different("movie", options.movie_file, "picture over time", space_time);
    require_different("contact sheet", options.sheet_file, "picture over time", space_time);
  }
}

/// The same scales and distinct titles, so that they can be compared.
void make_comparable(const std::vector<RunToDraw>& runs, const Drawings& drawings) {
  RunDrawing::ScaleEnds common;
  for (const auto& drawing : drawings) {
    for (const auto& [name, end] : drawing->scale_ends()) {
      double& largest = common[name];
      largest = std::max(largest, end);
    }
  }
  for (std::size_t i = 0; i < drawings.size(); ++i) {
    drawings[i]->set_scale_ends(common);
    drawings[i]->set_title(fmt::format("{}: {}", drawings[i]->name(), runs[i].scene.title));
  }
}

std::vector<std::vector<double>> times_of(const Drawings& drawings) {
  const auto time_unit = [](const auto& drawing) {
    const auto conversion = scene::unit_conversion(drawing->scene());
    return conversion ? conversion->time_unit : "";
  };
  const std::string unit = time_unit(drawings.front());
  const bool in_time = drawings.size() > 1 && !unit.empty() &&
                       std::ranges::all_of(drawings, [&](const auto& drawing) {
                         return time_unit(drawing) == unit;
                       });
  std::vector<std::vector<double>> result;
  for (const auto& drawing : drawings) {
    const auto conversion = scene::unit_conversion(drawing->scene());
    std::vector<double>& times = result.emplace_back();
    for (std::size_t number = 0; number < drawing->picture_count(); ++number) {
      const std::uint64_t step = drawing->step_of_picture(number);
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
  std::ranges::sort(all);
  all.erase(std::unique(all.begin(), all.end(),
                        [](double one, double next) { return next - one <= 1e-15 * next; }),
            all.end());
  return all;
}

/// How many pictures per second a movie has that is `moments` long: as wanted, or less if they have
/// to last longer.
double picture_rate(const RedrawOptions& options, std::size_t moments) {
  const auto most = static_cast<double>(options.frames_per_second);
  return options.movie_seconds
             ? std::min(most, static_cast<double>(moments) / *options.movie_seconds)
             : most;
}

/// Leaves the moments that a movie as long as wanted shows.
void choose_evenly(std::vector<double>& moments, const RedrawOptions& options) {
  if (!options.movie_seconds) {
    return;
  }
  const auto most = static_cast<std::size_t>(std::max(
      2.0, std::floor(*options.movie_seconds * static_cast<double>(options.frames_per_second))));
  std::size_t number = 0;
  std::erase_if(moments, [&, count = moments.size()](double /*moment*/) {
    return !is_evenly_chosen(number++, count, most);
  });
}

void require_writable(const fs::path& file) {
  const store::AtomicFile written(file);  // throws store::StoreError
}

}  // namespace

/// A contact sheet; of many moments a selection. Of several runs each has a column.
class SheetTarget {
 public:
  /// `moments`: their number. Throws RedrawError for an ending other than .png, store::StoreError.
  SheetTarget(const Drawings& drawings, const RedrawOptions& options, std::size_t moments)
      : drawings_(drawings),
        file_(options.sheet_file),
        columns_(options.sheet_columns),
        moments_(moments) {
    if (file_.extension() != ".png") {
      throw RedrawError(fmt::format("{}: a contact sheet ends in .png", file_.string()));
    }
    require_writable(file_);
  }

  /// Whether this moment (numbered from 0) is on the sheet.
  bool shows(std::size_t number) const {
    constexpr std::size_t kMaxRows = 6;
    return is_evenly_chosen(number, moments_,
                            kMaxRows * static_cast<std::size_t>(columns_) / drawings_.size());
  }
  /// The pictures of the runs at the next moment; left out if they look like those before.
  void add(const std::vector<Picture>& pictures) {
    std::vector<render::Tile> tiles;
    for (std::size_t run = 0; run < pictures.size(); ++run) {
      const RunDrawing& drawing = *drawings_[run];
      const std::string& moment = pictures[run].moment_text;
      tiles.push_back(drawing.painter().tile(pictures[run], render::cell_width(columns_)));
      tiles.back().label =
          drawings_.size() > 1 ? fmt::format("{}: {}", drawing.name(), moment) : moment;
    }
    const std::size_t before = tiles_.size() - std::min(tiles_.size(), tiles.size());
    const auto last = std::span(tiles_).subspan(before);
    if (!std::ranges::equal(last, tiles, {}, &render::Tile::view_image,
                            &render::Tile::view_image)) {
      std::ranges::move(tiles, std::back_inserter(tiles_));
    }
  }
  void finish() const {
    const scene::Scene& scene = drawings_.front()->scene();
    const render::Image sheet = render::contact_sheet(
        tiles_, columns_, render::cell_width(columns_), drawings_.size() > 1 ? "" : scene.title);
    store::write_whole_file(file_, image::encode_png(sheet, scene_metadata(scene)));
  }

 private:
  const Drawings& drawings_;
  fs::path file_;
  int columns_;
  std::size_t moments_;
  std::vector<render::Tile> tiles_;
};

class Redraw::Impl {
 public:
  Impl(const std::vector<RunToDraw>& runs, const RedrawOptions& options) : options_(options) {
    check_files(options);
    if (runs.size() > 1) {
      options_.sheet_columns = static_cast<int>(runs.size());
    }
    if (options.space_time && runs.size() > 1) {
      throw RedrawError(
          fmt::format("{}: a picture over time is of one run", options.space_time->file.string()));
    }
    for (const RunToDraw& run : runs) {
      folders_.push_back(run.picture_folder);
      drawings_.push_back(std::make_unique<RunDrawing>(
          run, options, options.max_bytes / static_cast<double>(runs.size())));
    }
    if (runs.size() > 1) {
      make_comparable(runs, drawings_);
    }
    const bool only_sheet = !options.sheet_file.empty() && options.movie_file.empty() &&
                            std::ranges::none_of(runs, [](const RunToDraw& run) {
                              return run.picture_folder.has_value();
                            });
    const int tile_width = only_sheet ? render::cell_width(options_.sheet_columns) : 0;
    for (const auto& drawing : drawings_) {
      drawing->prepare_painter(tile_width);
    }
    times_ = times_of(drawings_);
    moments_ = moments_of(times_);
    choose_evenly(moments_, options_);
    if (options.space_time) {
      RunDrawing& drawing = *drawings_.front();
      space_time_.emplace(drawing.scene(), drawing.initial_state(), *options.space_time,
                          drawing.picture_frames());
    }
  }

  std::size_t draw(const RedrawEvents& events) {
    const bool captions = std::ranges::any_of(
        drawings_, [](const auto& drawing) { return drawing->scene().output.frames->has_caption; });
    if (events.warning && captions && !render::font_warning().empty()) {
      events.warning(render::font_warning());
    }
    if (events.warning) {
      for (const auto& drawing : drawings_) {
        if (!drawing->frame_choice_note().empty()) {
          events.warning(drawing->frame_choice_note());
        }
      }
    }
    if (!options_.movie_file.empty() || !options_.sheet_file.empty()) {
      for (const auto& drawing : drawings_) {
        drawing->unify_arrow_scale();
      }
    }
    open_targets();
    record::IntervalTimer timer(events.progress_interval);
    record::TimeEstimate estimate;
    std::size_t number = 0;
    for (; number < moments_.size() && !stop_asked(); ++number) {
      const std::vector<std::size_t> pictures = pictures_at(moments_[number]);
      add_to_space_time(pictures.front());
      draw_moment(number, pictures);
      add_to_space_time(pictures.front() + 1);
      if (events.progress && timer.is_due()) {
        estimate.update(static_cast<double>(number + 1) / static_cast<double>(moments_.size()));
        events.progress({number + 1, moments_.size(), estimate.seconds_left()});
      }
    }
    if (number > 0) {
      writer_.finish();
      if (movie_) {
        movie_->finish();
        movie_file_->finish();
      }
      if (sheet_) {
        sheet_->finish();
      }
    }
    return number;
  }

  std::size_t moments() const { return moments_.size(); }
  SpaceTimePicture space_time() { return space_time_->picture(); }

 private:
  void open_targets() {
    captured_.assign(drawings_.size(), std::numeric_limits<std::size_t>::max());
    pictures_.resize(drawings_.size());
    if (!options_.movie_file.empty()) {
      open_movie();
    }
    if (!options_.sheet_file.empty()) {
      sheet_.emplace(drawings_, options_, moments_.size());
    }
    for (std::size_t run = 0; run < drawings_.size(); ++run) {
      if (folders_[run]) {
        folders_[run]->create(file_name(run, 0));
      }
    }
    if (space_time_) {
      require_writable(options_.space_time->file);
    }
  }

  /// All pictures are as wide as those of all drawings side by side.
  void open_movie() {
    int width = 0;
    int height = 0;
    for (const auto& drawing : drawings_) {
      width += drawing->painter().width();
      height = std::max(height, drawing->painter().height());
    }
    movie_file_.emplace(options_.movie_file);
    movie_.emplace(options_.movie_file, movie_file_->temporary_path(), width, height,
                   picture_rate(options_, moments_.size()), options_.stop_signal);
  }

  /// By run, the number of the picture nearest to a moment.
  std::vector<std::size_t> pictures_at(double moment) const {
    std::vector<std::size_t> result;
    for (const std::vector<double>& times : times_) {
      const auto nearest =
          std::ranges::min_element(times, {}, [&](double time) { return std::abs(time - moment); });
      result.push_back(static_cast<std::size_t>(nearest - times.begin()));
    }
    return result;
  }

  /// Draws the pictures of a moment for all that show it: they are captured here, and rasterized
  /// and written on another thread.
  void draw_moment(std::size_t number, const std::vector<std::size_t>& pictures) {
    const bool on_sheet = sheet_ && sheet_->shows(number);
    const auto is_there = [](const auto& folder) { return folder.has_value(); };
    if (!on_sheet && !movie_ && std::ranges::none_of(folders_, is_there)) {
      return;
    }
    std::vector<std::optional<CapturedFrame>> frames(pictures.size());
    for (std::size_t run = 0; run < pictures.size(); ++run) {
      if (std::exchange(captured_[run], pictures[run]) != pictures[run]) {
        frames[run] = drawings_[run]->capture(pictures[run]);
      }
    }
    writer_.start([this, on_sheet, pictures, frames = std::move(frames)] {
      for (std::size_t run = 0; run < pictures.size(); ++run) {
        if (!frames[run]) {
          continue;
        }
        FramePainter& painter = drawings_[run]->painter();
        const Picture& picture = pictures_[run] = painter.rasterize(*frames[run]);
        if (folders_[run]) {
          folders_[run]->write(file_name(run, pictures[run]),
                               options_.as_pdf ? painter.pdf(*frames[run])
                                               : image::encode_png(picture.image, picture.text));
        }
      }
      if (movie_) {
        std::vector<render::Image> images;
        std::ranges::transform(pictures_, std::back_inserter(images), &Picture::image);
        movie_->add(render::side_by_side(images));
      }
      if (on_sheet) {
        sheet_->add(pictures_);
      }
    });
  }

  std::string file_name(std::size_t run, std::size_t picture) const {
    const scene::Scene& scene = drawings_[run]->scene();
    return store::frame_name(scene.name, drawings_[run]->step_of_picture(picture),
                             scene::step_digits(scene), options_.as_pdf ? ".pdf" : ".png");
  }

  /// Adds the pictures before this one to the space-time picture, also those that no movie shows.
  void add_to_space_time(std::size_t end) {
    for (; space_time_ && frames_added_ < end; ++frames_added_) {
      drawings_.front()->add_frame_to(*space_time_, frames_added_);
    }
  }

  bool stop_asked() const {
    return options_.stop_signal != nullptr && options_.stop_signal->load() != 0;
  }

  RedrawOptions options_;
  std::vector<std::optional<store::OutputFolder>> folders_;  // by run
  Drawings drawings_;
  std::vector<std::vector<double>> times_;  // by run, of its pictures
  std::vector<double> moments_;
  std::optional<SpaceTimePainter> space_time_;
  std::size_t frames_added_ = 0;                 // to space_time_
  std::vector<std::size_t> captured_;            // by run, number of the last picture captured
  std::vector<Picture> pictures_;                // by run, the last one drawn
  std::optional<store::AtomicFile> movie_file_;  // appears when it is complete
  std::optional<render::Movie> movie_;
  std::optional<SheetTarget> sheet_;
  tasks::BackgroundCall writer_;  // last: at the end it waits for its thread, which uses the others
};

Redraw::Redraw(const std::vector<RunToDraw>& runs, const RedrawOptions& options)
    : impl_(std::make_unique<Impl>(runs, options)) {}

Redraw::~Redraw() = default;

std::size_t Redraw::draw(const RedrawEvents& events) {
  return impl_->draw(events);
}

std::size_t Redraw::moment_count() const {
  return impl_->moments();
}

SpaceTimePicture Redraw::space_time_picture() {
  return impl_->space_time();
}

}  // namespace clca::drawing
