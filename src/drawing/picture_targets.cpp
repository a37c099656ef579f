#include "drawing/picture_targets.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "clca/store/file.hpp"
#include "clca/store/run_folder.hpp"
#include "drawing/run_drawing.hpp"

namespace clca::drawing {

namespace {

constexpr std::size_t kMaxRows = 6;  // of a sheet

/// Throws store::StoreError if `file` could not be written.
void check_writable(const std::filesystem::path& file) {
  const store::AtomicFile written(file);
}

render::MovieFormat format_of(const std::filesystem::path& movie) {
  if (const auto format = render::movie_format(movie)) {
    return *format;
  }
  throw RedrawError(fmt::format(
      "{}: is not a movie; expected the ending .mp4, .webm, .webp, .gif or .png (animated)",
      movie.string()));
}

}  // namespace

MovieTarget::MovieTarget(const render::PixelBox& size, const std::filesystem::path& file,
                         double frames_per_second, const std::atomic<int>* stop)
    : path_(file),
      file_(file),
      movie_(file_.temporary_path(), format_of(file), size.width, size.height, frames_per_second,
             stop) {}

void MovieTarget::add(const render::Image& image) {
  naming_file([&] { movie_.add(image); });
}

/// Errors name the movie, as ffmpeg only knows the temporary file.
template <class Act>
void MovieTarget::naming_file(Act act) {
  try {
    act();
  } catch (const render::MovieError& error) {
    throw render::MovieError(fmt::format("cannot write {}: {}", path_.string(), error.what()));
  }
}

void MovieTarget::finish() {
  naming_file([&] { movie_.finish(); });
  file_.finish();
}

SheetTarget::SheetTarget(const std::vector<std::unique_ptr<RunDrawing>>& drawings,
                         std::filesystem::path file, int columns, std::size_t moments)
    : drawings_(drawings), file_(std::move(file)), columns_(columns), moments_(moments) {
  if (file_.extension() != ".png") {
    throw RedrawError(fmt::format("{}: a contact sheet ends in .png", file_.string()));
  }
  check_writable(file_);
}

bool SheetTarget::shows(std::size_t number) const {
  return is_among(number, moments_,
                  kMaxRows * static_cast<std::size_t>(columns_) / drawings_.size());
}

void SheetTarget::add(std::size_t run, const Picture& picture) {
  const RunDrawing& drawing = *drawings_[run];
  tiles_.push_back(drawing.painter().tile(picture, render::cell_width(columns_)));
  tiles_.back().label =
      drawings_.size() > 1 ? fmt::format("{}: {}", drawing.name(), picture.moment) : picture.moment;
}

void SheetTarget::end_moment() {
  const auto runs = static_cast<std::ptrdiff_t>(drawings_.size());
  const auto same = [](const render::Tile& tile, const render::Tile& before) {
    return tile.view == before.view;
  };
  if (tiles_.size() >= 2 * drawings_.size() &&
      std::equal(tiles_.end() - runs, tiles_.end(), tiles_.end() - 2 * runs, same)) {
    tiles_.resize(tiles_.size() - drawings_.size());
  }
}

void SheetTarget::finish() {
  const scene::Scene& scene = drawings_.front()->scene();
  const render::Image sheet = render::contact_sheet(tiles_, columns_, render::cell_width(columns_),
                                                    drawings_.size() > 1 ? "" : scene.title);
  store::write_whole(file_, image::encode_png(sheet, scene_metadata(scene)));
}

PictureTargets::PictureTargets(const std::vector<std::unique_ptr<RunDrawing>>& drawings,
                               const std::vector<std::optional<store::OutputFolder>>& folders,
                               const RedrawOptions& options, std::size_t moments, double rate)
    : drawings_(drawings),
      folders_(folders),
      pdf_(options.pdf),
      captured_(drawings.size(), std::numeric_limits<std::size_t>::max()),
      pictures_(drawings.size()) {
  if (!options.movie.empty()) {
    render::PixelBox size;
    for (const auto& drawing : drawings) {
      size.width += drawing->painter().width();
      size.height = std::max(size.height, drawing->painter().height());
    }
    movie_.emplace(size, options.movie, rate, options.stop);
  }
  if (!options.sheet.empty()) {
    sheet_.emplace(drawings, options.sheet, options.columns, moments);
  }
  for (std::size_t run = 0; run < drawings.size(); ++run) {
    if (folders[run]) {
      folders[run]->create(file_name(run, 0));  // throws where it cannot be written
    }
  }
}

std::string PictureTargets::file_name(std::size_t run, std::size_t picture) const {
  const scene::Scene& scene = drawings_[run]->scene();
  return store::frame_name(scene.name, drawings_[run]->step(picture), scene::step_digits(scene),
                           pdf_ ? ".pdf" : ".png");
}

bool PictureTargets::want(std::size_t number) const {
  return std::any_of(folders_.begin(), folders_.end(),
                     [](const auto& folder) { return folder.has_value(); }) ||
         movie_ || (sheet_ && sheet_->shows(number));
}

void PictureTargets::add(std::size_t number, const std::vector<std::size_t>& pictures) {
  std::vector<std::optional<CapturedFrame>> frames(pictures.size());
  for (std::size_t run = 0; run < pictures.size(); ++run) {
    if (captured_[run] != pictures[run]) {
      captured_[run] = pictures[run];
      frames[run] = drawings_[run]->capture(pictures[run]);
    }
  }
  writer_.start([this, number, pictures, frames = std::move(frames)] {
    for (std::size_t run = 0; run < pictures.size(); ++run) {
      if (frames[run]) {
        draw(run, pictures[run], *frames[run]);
      }
    }
    end_moment(number);
  });
}

void PictureTargets::draw(std::size_t run, std::size_t picture, const CapturedFrame& frame) {
  FramePainter& painter = drawings_[run]->painter();
  pictures_[run] = painter.rasterize(frame);
  if (folders_[run]) {
    folders_[run]->write(
        file_name(run, picture),
        pdf_ ? painter.pdf(frame) : image::encode_png(pictures_[run].image, pictures_[run].text));
  }
}

void PictureTargets::end_moment(std::size_t number) {
  if (movie_ && pictures_.size() == 1) {
    movie_->add(pictures_.front().image);
  } else if (movie_) {
    std::vector<render::Image> images;
    for (const Picture& picture : pictures_) {
      images.push_back(picture.image);
    }
    movie_->add(render::side_by_side(images));
  }
  if (sheet_ && sheet_->shows(number)) {
    for (std::size_t run = 0; run < pictures_.size(); ++run) {
      sheet_->add(run, pictures_[run]);
    }
    sheet_->end_moment();
  }
}

void PictureTargets::finish() {
  writer_.finish();
  if (movie_) {
    movie_->finish();
  }
  if (sheet_) {
    sheet_->finish();
  }
}

}  // namespace clca::drawing
