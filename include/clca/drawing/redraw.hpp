#pragma once
// Draws runs from their trajectories without simulating: pictures, a movie, a contact sheet, a line
// over time.

#include <atomic>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "clca/image/image.hpp"
#include "clca/scene/parse.hpp"
#include "clca/scene/scene.hpp"
#include "clca/store/output_folder.hpp"
#include "clca/text/read.hpp"

namespace clca::drawing {

/// The run cannot be drawn as requested. what() is one line.
class RedrawError : public text::InputError {
 public:
  using InputError::InputError;
};

/// A run to be drawn.
struct RunToDraw {
  /// The scene of the run, with `frames` as they should be now; `every` applies to frames of the
  /// trajectory. Each stage begins and ends with a picture.
  scene::Scene scene;
  std::filesystem::path folder;                      ///< of the run
  std::optional<store::OutputFolder> pictures = {};  ///< for pictures one by one
};

/// The scene of the run in `folder` with these overrides, which may change pictures alone, and
/// `frames` where it has none. Throws RedrawError, scene::SceneError, store::StoreError.
scene::Scene drawn_scene(const std::filesystem::path& folder,
                         const std::vector<scene::Override>& overrides);

/// The picture of a step of the trajectory, within `max_bytes` of memory. Throws as Redraw.
image::Image picture(RunToDraw run, std::uint64_t step, double max_bytes);

/// Which space-time picture: a column of the box or its free surface over time.
struct SpaceTimeOptions {
  std::filesystem::path file = {};    ///< a PNG file, that the caller writes
  std::optional<double> column = {};  ///< x, lattice spacings; none: the free surface
  double slit = 1;                    ///< width around it, lattice spacings
};

struct RedrawOptions {
  bool pdf = false;                  ///< pictures one by one, else PNG
  std::filesystem::path movie = {};  ///< see render::movie_format; empty: none
  int frames_per_second = 25;        ///< of the movie
  /// Length of the movie, seconds: of more pictures than it needs it has some, evenly chosen; of
  /// fewer, it shows fewer per second. None: it has all.
  std::optional<double> duration = {};
  std::filesystem::path sheet = {};                 ///< a PNG file; empty: none
  int columns = 4;                                  ///< of the sheet of one run
  std::optional<SpaceTimeOptions> space_time = {};  ///< of one run only
  std::optional<std::string> stage = {};  ///< only the pictures of this one, from its beginning
  /// First step. If no picture is in the range, the nearest frame of the trajectory is drawn.
  std::uint64_t from = 0;
  std::uint64_t to = std::numeric_limits<std::uint64_t>::max();  ///< last step
  double max_bytes = std::numeric_limits<double>::infinity();  ///< of memory, for all trajectories
  /// Checked before each picture: if not zero, drawing ends and the files are completed with what
  /// was drawn.
  const std::atomic<int>* stop = nullptr;
};

/// A column of the box or its free surface over time.
struct SpaceTimePicture {
  image::Image content = {};  ///< time to the right, position upwards; white where nothing is
  std::string figure = {};    ///< title, axes, stages, legend and text around it, as JSON
};

struct RedrawProgress {
  std::size_t drawn = 0;
  std::size_t pictures = 0;
  std::optional<double> seconds_left;
};

/// What Redraw::draw() calls; all optional.
struct RedrawEvents {
  std::function<void(const RedrawProgress&)> progress = {};
  std::chrono::milliseconds progress_interval{100};  ///< least time between two of them
  std::function<void(const std::string&)> warning = {};
};

/// Several runs share the ends of their colour bars and the scales of forces and velocities. Their
/// movie and sheet show them side by side at equal times (if all are of the contact model) or
/// steps: a moment for each picture of each run, with the nearest pictures of the others.
class Redraw {
 public:
  /// Checks what is to be drawn and that it can be; draws nothing. Throws RedrawError,
  /// scene::SceneError, render::MovieError, store::StoreError. `runs`: at least one.
  Redraw(const std::vector<RunToDraw>& runs, const RedrawOptions& options);
  ~Redraw();
  Redraw(const Redraw&) = delete;
  Redraw& operator=(const Redraw&) = delete;

  /// Call once. Returns the number of moments drawn, less than moments() if stopped.
  /// Throws render::MovieError, store::StoreError, and process::StoppedError if ffmpeg did not end
  /// in time.
  std::size_t draw(const RedrawEvents& events = {});
  /// Number of times or steps at which there is a picture; of a single run, of all its pictures.
  std::size_t moments() const;
  /// After draw(), if it was asked for: the space-time picture of the frames so far.
  SpaceTimePicture space_time();

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace clca::drawing
