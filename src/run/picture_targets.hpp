#pragma once
// Where pictures that are drawn again go: files, a movie, a contact sheet.

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

/// One picture after the other into a file of its own.
class FilesTarget {
 public:
  /// `step`: of the first picture, to find out whether it can be written. Throws store::StoreError.
  FilesTarget(const scene::Scene& scene, store::OutputFolder folder, std::uint64_t step);
  void add(Picture picture, std::uint64_t step);
  void finish() { writer_.finish(); }

 private:
  store::OutputFolder folder_;
  std::string scene_;
  FrameWriter writer_;
};

/// A movie that appears when it is whole.
class MovieTarget {
 public:
  /// Throws RedrawError for an ending that is none of a movie, render::MovieError,
  /// store::StoreError.
  MovieTarget(const scene::Frames& frames, const std::filesystem::path& file, int frames_per_second,
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

/// A contact sheet, of some of the pictures where there are many.
class SheetTarget {
 public:
  /// `pictures`: that will come. Throws RedrawError for an ending other than .png,
  /// store::StoreError.
  SheetTarget(const scene::Scene& scene, std::filesystem::path file, int columns,
              std::size_t pictures);
  /// Whether the picture of this number, from 0, has a place.
  bool shows(std::size_t number) const;
  void add(const Picture& picture);
  void finish();

 private:
  const scene::Scene& scene_;
  std::filesystem::path file_;
  int columns_;
  std::size_t pictures_;
  std::vector<render::LabelledImage> images_;
  render::PngText text_;
};

class PictureTargets {
 public:
  /// `step`: of the first of so many `pictures`. Throws as the targets do.
  PictureTargets(const scene::Scene& scene, const RedrawOptions& options, std::size_t pictures,
                 std::uint64_t step);

  /// Whether anybody wants the picture of this number, from 0.
  bool want(std::size_t number) const;
  void add(Picture picture, std::size_t number, std::uint64_t step);
  /// Writes what has come so far, whole.
  void finish();

 private:
  std::optional<FilesTarget> files_;
  std::optional<MovieTarget> movie_;
  std::optional<SheetTarget> sheet_;
};

}  // namespace clca::run
