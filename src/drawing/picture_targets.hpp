#pragma once
// Targets for redrawn pictures: files, a movie, a contact sheet.

#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "clca/drawing/redraw.hpp"
#include "clca/render/contact_sheet.hpp"
#include "clca/render/movie.hpp"
#include "clca/store/output_folder.hpp"
#include "clca/tasks/threads.hpp"
#include "drawing/internal/frame_painter.hpp"
#include "drawing/run_drawing.hpp"

namespace clca::drawing {

/// A movie file that appears when it is complete.
class MovieTarget {
 public:
  /// Throws RedrawError for a file ending that is no movie format, render::MovieError,
  /// store::StoreError.
  /// All pictures are `size` large.
  MovieTarget(const render::PixelBox& size, const std::filesystem::path& file,
              double frames_per_second, const std::atomic<int>* stop);
  void add(const render::Image& image);
  void finish();

 private:
  template <class Act>
  void naming_file(Act act);

  std::filesystem::path path_;
  store::AtomicFile file_;
  render::Movie movie_;
};

/// A contact sheet; of many moments a selection. Of several runs each has a column.
class SheetTarget {
 public:
  /// `moments`: their number. Throws RedrawError for an ending other than .png, store::StoreError.
  SheetTarget(const std::vector<std::unique_ptr<RunDrawing>>& drawings, std::filesystem::path file,
              int columns, std::size_t moments);
  /// Whether this moment (numbered from 0) is on the sheet.
  bool shows(std::size_t number) const;
  /// A picture of the next moment: one of each run, then end_moment().
  void add(std::size_t run, const Picture& picture);
  /// Leaves the pictures out if they look like those before.
  void end_moment();
  void finish();

 private:
  const std::vector<std::unique_ptr<RunDrawing>>& drawings_;
  std::filesystem::path file_;
  int columns_;
  std::size_t moments_;
  std::vector<render::Tile> tiles_;
};

class PictureTargets {
 public:
  /// `folders`: by run, for its pictures one by one. `moments`: their number. `rate`: pictures per
  /// second of a movie. Throws as the targets.
  PictureTargets(const std::vector<std::unique_ptr<RunDrawing>>& drawings,
                 const std::vector<std::optional<store::OutputFolder>>& folders,
                 const RedrawOptions& options, std::size_t moments, double rate);

  /// Whether any target uses this moment (numbered from 0).
  bool want(std::size_t number) const;
  /// A moment, with the numbers of the pictures of the runs. They are captured here, and drawn and
  /// written on another thread.
  void add(std::size_t number, const std::vector<std::size_t>& pictures);
  /// Completes all files with the pictures so far.
  void finish();

 private:
  std::string file_name(std::size_t run, std::size_t picture) const;
  void draw(std::size_t run, std::size_t picture, const CapturedFrame& frame);
  void end_moment(std::size_t number);

  const std::vector<std::unique_ptr<RunDrawing>>& drawings_;
  const std::vector<std::optional<store::OutputFolder>>& folders_;  // by run
  bool pdf_;
  std::vector<std::size_t> captured_;  // by run, the last one
  std::vector<Picture> pictures_;      // by run, the last one
  std::optional<MovieTarget> movie_;
  std::optional<SheetTarget> sheet_;
  tasks::Background writer_;  // last: at the end it waits for its thread, which uses the others
};

}  // namespace clca::drawing
