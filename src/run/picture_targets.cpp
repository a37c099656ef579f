#include "run/picture_targets.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "clca/store/file.hpp"
#include "clca/store/run_folder.hpp"
#include "run/run_drawing.hpp"

namespace clca::run {

namespace {

constexpr std::size_t kMaxRows = 6;  // of a sheet

int cell_width(int columns) {
  constexpr int kSheet = 1920;  // pixels, about
  return std::clamp(kSheet / columns, 240, 640);
}

/// Throws store::StoreError if `file` could not be written.
void check_writable(const std::filesystem::path& file) {
  store::named_file(file).create();
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

FilesTarget::FilesTarget(const scene::Scene& scene, store::OutputFolder folder, bool pdf,
                         std::uint64_t step)
    : folder_(std::move(folder)),
      scene_(scene.name),
      digits_(scene::step_digits(scene)),
      pdf_(pdf) {
  folder_.create(name(step));  // throws where it cannot be written
}

std::string FilesTarget::name(std::uint64_t step) const {
  return store::frame_name(scene_, step, digits_, pdf_ ? ".pdf" : ".png");
}

void FilesTarget::add(FramePainter& painter, const CapturedFrame& frame, const Picture& picture,
                      std::uint64_t step) {
  if (pdf_) {
    folder_.write(name(step), painter.pdf(frame));
  } else {
    writer_.write(folder_, name(step),
                  [picture] { return image::encode_png(picture.image, picture.text); });
  }
}

MovieTarget::MovieTarget(const render::PixelBox& size, const std::filesystem::path& file,
                         double frames_per_second, const std::atomic<int>* stop)
    : path_(file),
      file_(store::named_file(file).create()),
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
    : drawings_(drawings),
      file_(std::move(file)),
      columns_(drawings.size() > 1 ? static_cast<int>(drawings.size()) : columns),
      moments_(moments) {
  if (file_.extension() != ".png") {
    throw RedrawError(fmt::format("{}: a contact sheet ends in .png", file_.string()));
  }
  check_writable(file_);
}

bool SheetTarget::shows(std::size_t number) const {
  return is_among(number, moments_,
                  kMaxRows * static_cast<std::size_t>(columns_) / drawings_.size());
}

void SheetTarget::add(const Picture& picture, const std::string& label) {
  if (tiles_.empty()) {
    legend_ = picture.legend;
  } else if (legend_) {
    legend_ = render::common_legend(*legend_, picture.legend);
  }
  tiles_.push_back(render::tile(picture.image, picture.parts, cell_width(columns_), label));
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
  if (legend_) {
    const render::Image legend = drawings_.front()->painter().legend(*legend_);
    for (render::Tile& tile : tiles_) {
      tile.legend = legend;
    }
  }
  const scene::Scene& scene = drawings_.front()->scene();
  const render::Image sheet = render::contact_sheet(tiles_, columns_, cell_width(columns_),
                                                    drawings_.size() > 1 ? "" : scene.title);
  store::write_whole(file_, image::encode_png(sheet, scene_metadata(scene)));
}

PictureTargets::PictureTargets(const std::vector<std::unique_ptr<RunDrawing>>& drawings,
                               const std::vector<std::optional<store::OutputFolder>>& folders,
                               const RedrawOptions& options, std::size_t moments, double rate)
    : drawings_(drawings), pictures_(drawings.size()), files_(drawings.size()) {
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
      files_[run] = std::make_unique<FilesTarget>(drawings[run]->scene(), *folders[run],
                                                  options.pdf, drawings[run]->step(0));
    }
  }
}

bool PictureTargets::want(std::size_t number) const {
  return std::any_of(files_.begin(), files_.end(), [](const auto& files) { return bool{files}; }) ||
         movie_ || (sheet_ && sheet_->shows(number));
}

void PictureTargets::add(std::size_t run, std::size_t picture) {
  FramePainter& painter = drawings_[run]->painter();
  const CapturedFrame frame = drawings_[run]->capture(picture);
  pictures_[run] = painter.rasterize(frame);
  if (files_[run]) {
    files_[run]->add(painter, frame, pictures_[run], drawings_[run]->step(picture));
  }
}

void PictureTargets::end_moment(std::size_t number) {
  if (movie_) {
    std::vector<render::Image> images;
    for (const Picture& picture : pictures_) {
      images.push_back(picture.image);
    }
    movie_->add(render::side_by_side(images));
  }
  if (sheet_ && sheet_->shows(number)) {
    for (std::size_t run = 0; run < pictures_.size(); ++run) {
      const std::string& moment = pictures_[run].moment;
      sheet_->add(pictures_[run], pictures_.size() > 1
                                      ? fmt::format("{}: {}", drawings_[run]->name(), moment)
                                      : moment);
    }
    sheet_->end_moment();
  }
}

void PictureTargets::finish() {
  for (const auto& files : files_) {
    if (files) {
      files->finish();
    }
  }
  if (movie_) {
    movie_->finish();
  }
  if (sheet_) {
    sheet_->finish();
  }
}

}  // namespace clca::run
