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

struct RunToDraw {
  /// The scene of the run, with `frames` as they should be now; `every` applies to frames of the
  /// trajectory. Each stage begins and ends with a picture.
  scene::Scene scene;
  std::filesystem::path run_folder;                        ///< of the run
  std::optional<store::OutputFolder> picture_folder = {};  ///< for single pictures
};

/// The scene of the run in `folder` with these overrides, which may change pictures alone, and
/// `frames` where it has none. Throws RedrawError, scene::SceneError, store::StoreError.
scene::Scene scene_for_drawing(const std::filesystem::path& folder,
                               const std::vector<scene::Override>& overrides);

/// The picture of a step of the trajectory, within `max_bytes` of memory. Throws as Redraw.
image::Image picture_of_step(RunToDraw run, std::uint64_t step, double max_bytes);

/// Which space-time picture: a column of the box or its free surface over time.
struct SpaceTimeOptions {
  std::filesystem::path file = {};      ///< a PNG file, that the caller writes
  std::optional<double> column_x = {};  ///< x, lattice spacings; none: the free surface
  double slit_width = 1;                ///< width around it, lattice spacings
};

struct RedrawOptions {
  bool as_pdf = false;                    ///< single pictures are PDF, else PNG
  std::filesystem::path movie_file = {};  ///< see render::movie_format; empty: none
  int frames_per_second = 25;             ///< of the movie
  /// Length of the movie, seconds. Of too many pictures, evenly chosen ones are shown; too few are
  /// shown longer. None: it has all pictures.
  std::optional<double> movie_seconds = {};
  std::filesystem::path sheet_file = {};            ///< a PNG file; empty: none
  int sheet_columns = 4;                            ///< columns of the sheet of a single run
  std::optional<SpaceTimeOptions> space_time = {};  ///< for a single run only
  std::optional<std::string> only_stage = {};  ///< only pictures of this stage, with its beginning
  /// First step. If no picture is in the range, the nearest frame of the trajectory is drawn.
  std::uint64_t first_step = 0;
  std::uint64_t last_step = std::numeric_limits<std::uint64_t>::max();
  double max_bytes = std::numeric_limits<double>::infinity();  ///< of memory, for all trajectories
  /// Checked before each picture: if not zero, drawing ends and the files are completed with what
  /// was drawn.
  const std::atomic<int>* stop_signal = nullptr;
};

/// A column of the box or its free surface over time.
struct SpaceTimePicture {
  image::Image plot_image = {};  ///< time to the right, position upwards; white where nothing is
  std::string figure_json = {};  ///< title, axes, stages, legend and text around it, as JSON
};

struct RedrawProgress {
  std::size_t drawn_pictures = 0;
  std::size_t total_pictures = 0;
  std::optional<double> seconds_left;
};

/// Callbacks of Redraw::draw(); all optional.
struct RedrawEvents {
  std::function<void(const RedrawProgress&)> progress = {};
  std::chrono::milliseconds progress_interval{100};  ///< least time between progress calls
  std::function<void(const std::string&)> warning = {};
};

/// Several runs share the ends of their colour bars and the scales of forces and velocities. Their
/// movie and sheet show them side by side at equal times (if all have them in one unit) or
/// steps: a moment for each picture of each run, with the nearest pictures of the others.
class Redraw {
 public:
  /// Checks what is to be drawn and that it can be; draws nothing. Throws RedrawError,
  /// scene::SceneError, render::MovieError, store::StoreError. `runs`: at least one.
  Redraw(const std::vector<RunToDraw>& runs, const RedrawOptions& options);
  ~Redraw();
  Redraw(const Redraw&) = delete;
  Redraw& operator=(const Redraw&) = delete;

  /// Call once. Returns the number of moments drawn, less than moment_count() if stopped.
  /// Throws render::MovieError, store::StoreError, and process::StoppedError if ffmpeg did not end
  /// in time.
  std::size_t draw(const RedrawEvents& events = {});
  /// Number of times or steps at which there is a picture; of a single run, of all its pictures.
  std::size_t moment_count() const;
  /// After draw(), if requested: the space-time picture of the frames so far.
  SpaceTimePicture space_time_picture();

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace clca::drawing
