#pragma once
// Targets for redrawn pictures: files, a movie, a contact sheet.

#include <filesystem>
#include <optional>
#include <vector>

#include "clca/render/contact_sheet.hpp"
#include "clca/render/movie.hpp"
#include "clca/run/redraw.hpp"
#include "clca/store/output_folder.hpp"
#include "run/frame_painter.hpp"
#include "run/frame_writer.hpp"

namespace clca::run {

/// Writes each picture to its own file.
class FilesTarget {
 public:
  /// `step`: of the first picture, to check that it can be written. Throws store::StoreError.
  FilesTarget(const scene::Scene& scene, store::OutputFolder folder, std::uint64_t step);
  void add(Picture picture, std::uint64_t step);
  void finish() { writer_.finish(); }

 private:
  store::OutputFolder folder_;
  std::string scene_;
  FrameWriter writer_;
};

/// A movie file that appears when it is complete.
class MovieTarget {
 public:
  /// Throws RedrawError for a file ending that is no movie format, render::MovieError,
  /// store::StoreError.
  MovieTarget(const FramePainter& painter, const std::filesystem::path& file, int frames_per_second,
              const std::atomic<int>* stop);
  void add(const render::Image& image);
  void finish();

 private:
  template <class Act>
  void naming_file(Act act);

  std::filesystem::path path_;
  store::AtomicFile file_;
  render::Movie movie_;
};

/// A contact sheet; of many pictures a selection.
class SheetTarget {
 public:
  /// `pictures`: their total number. Throws RedrawError for an ending other than .png,
  /// store::StoreError.
  SheetTarget(const scene::Scene& scene, const FramePainter& painter, std::filesystem::path file,
              int columns, std::size_t pictures);
  /// Whether this picture (numbered from 0) is on the sheet.
  bool shows(std::size_t number) const;
  void add(const Picture& picture);
  void finish();

 private:
  const scene::Scene& scene_;
  const FramePainter& painter_;
  std::filesystem::path file_;
  int columns_;
  std::size_t pictures_;
  std::vector<render::Tile> tiles_;
  std::optional<render::Legend> legend_;  ///< of all, if they have one
};

class PictureTargets {
 public:
  /// `step`: of the first picture; `pictures`: their number. Throws as the targets.
  PictureTargets(const scene::Scene& scene, const FramePainter& painter,
                 const RedrawOptions& options, std::size_t pictures, std::uint64_t step);

  /// Whether any target uses this picture (numbered from 0).
  bool want(std::size_t number) const;
  void add(Picture picture, std::size_t number, std::uint64_t step);
  /// Completes all files with the pictures so far.
  void finish();

 private:
  std::optional<FilesTarget> files_;
  std::optional<MovieTarget> movie_;
  std::optional<SheetTarget> sheet_;
};

}  // namespace clca::run
