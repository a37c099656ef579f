#include "run/picture_targets.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "clca/store/file.hpp"
#include "clca/store/run_folder.hpp"
#include "run/frame_choice.hpp"

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
      "{}: no ending of a movie; there are .mp4, .webm and .png (animated)", movie.string()));
}

}  // namespace

FilesTarget::FilesTarget(const scene::Scene& scene, store::OutputFolder folder, std::uint64_t step)
    : folder_(std::move(folder)), scene_(scene.name) {
  folder_.create(store::frame_name(scene_, step));  // throws where it cannot be written
}

void FilesTarget::add(Picture picture, std::uint64_t step) {
  writer_.write(folder_, store::frame_name(scene_, step),
                [picture = std::move(picture)] { return picture; });
}

MovieTarget::MovieTarget(const FramePainter& painter, const std::filesystem::path& file,
                         int frames_per_second, const std::atomic<int>* stop)
    : path_(file),
      file_(store::named_file(file).create()),
      movie_(file_.temporary_path(), format_of(file), painter.width(), painter.height(),
             frames_per_second, stop) {}

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

SheetTarget::SheetTarget(const scene::Scene& scene, const FramePainter& painter,
                         std::filesystem::path file, int columns, std::size_t pictures)
    : scene_(scene),
      painter_(painter),
      file_(std::move(file)),
      columns_(columns),
      pictures_(pictures) {
  if (file_.extension() != ".png") {
    throw RedrawError(fmt::format("{}: a contact sheet ends in .png", file_.string()));
  }
  check_writable(file_);
}

bool SheetTarget::shows(std::size_t number) const {
  return is_among(number, pictures_, kMaxRows * static_cast<std::size_t>(columns_));
}

void SheetTarget::add(const Picture& picture) {
  if (tiles_.empty()) {
    legend_ = picture.legend;
  } else if (legend_) {
    legend_ = render::common_legend(*legend_, picture.legend);
  }
  tiles_.push_back(
      render::tile(picture.image, picture.parts, cell_width(columns_), picture.moment));
}

void SheetTarget::finish() {
  if (legend_) {
    const render::Image legend = painter_.legend(*legend_);
    for (render::Tile& tile : tiles_) {
      tile.legend = legend;
    }
  }
  const render::Image sheet =
      render::contact_sheet(tiles_, columns_, cell_width(columns_), scene_.title);
  store::write_whole(file_, image::encode_png(sheet, scene_text(scene_)));
}

PictureTargets::PictureTargets(const scene::Scene& scene, const FramePainter& painter,
                               const RedrawOptions& options, std::size_t pictures,
                               std::uint64_t step) {
  if (!options.movie.empty()) {
    movie_.emplace(painter, options.movie, options.frames_per_second, options.stop);
  }
  if (!options.sheet.empty()) {
    sheet_.emplace(scene, painter, options.sheet, options.columns, pictures);
  }
  if (options.folder) {
    files_.emplace(scene, *options.folder, step);
  }
}

bool PictureTargets::want(std::size_t number) const {
  return files_ || movie_ || (sheet_ && sheet_->shows(number));
}

void PictureTargets::add(Picture picture, std::size_t number, std::uint64_t step) {
  if (movie_) {
    movie_->add(picture.image);
  }
  if (sheet_ && sheet_->shows(number)) {
    sheet_->add(picture);
  }
  if (files_) {
    files_->add(std::move(picture), step);
  }
}

void PictureTargets::finish() {
  if (files_) {
    files_->finish();
  }
  if (movie_) {
    movie_->finish();
  }
  if (sheet_) {
    sheet_->finish();
  }
}

}  // namespace clca::run
