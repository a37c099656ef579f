#pragma once
// Draws a run again from its trajectory, without simulating: pictures, a movie, a contact sheet.

#include <atomic>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

#include "clca/scene/scene.hpp"
#include "clca/store/output_folder.hpp"

namespace clca::run {

/// What cannot be drawn again, or not so. what() is one line.
class RedrawError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct RedrawOptions {
  std::filesystem::path run = {};                  ///< folder of the run
  std::optional<store::OutputFolder> folder = {};  ///< for pictures one by one
  std::filesystem::path movie = {};                ///< see render::movie_format; empty: none
  int frames_per_second = 25;                      ///< of the movie
  std::filesystem::path sheet = {};                ///< a PNG file; empty: none
  int columns = 4;                                 ///< of the sheet
  std::uint64_t from = 0;                          ///< first step
  std::uint64_t to = std::numeric_limits<std::uint64_t>::max();  ///< last step
  double most_bytes = std::numeric_limits<double>::infinity();   ///< of memory, for the trajectory
  /// Looked at before each picture: when it is not zero the drawing ends with what it has, whole.
  const std::atomic<int>* stop = nullptr;
};

struct RedrawProgress {
  std::size_t drawn = 0;
  std::size_t pictures = 0;
  std::optional<double> seconds_left;
};

/// All optional.
struct RedrawEvents {
  std::function<void(const RedrawProgress&)> progress = {};
  std::chrono::milliseconds progress_interval{100};  ///< least time between two of them
  std::function<void(const std::string&)> warning = {};
};

class Redraw {
 public:
  /// Finds out what is to be drawn and that it can be drawn and written; draws nothing. `scene`:
  /// that of the run, with frames as they are to be now; its `every` holds for the frames of the
  /// trajectory, each stage beginning and ending with one. Throws RedrawError, ScenePlaceError,
  /// render::MovieError, store::StoreError.
  Redraw(const scene::Scene& scene, const RedrawOptions& options);
  ~Redraw();
  Redraw(const Redraw&) = delete;
  Redraw& operator=(const Redraw&) = delete;

  /// Call once. Returns the number of pictures drawn: less than pictures() when it was stopped.
  /// Throws render::MovieError, store::StoreError, process::Stopped where ffmpeg did not end in
  /// time.
  std::size_t draw(const RedrawEvents& events = {});
  /// To be drawn.
  std::size_t pictures() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace clca::run
