#pragma once
// The pictures of one run, from its trajectory.

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "clca/contact/vessel.hpp"
#include "clca/drawing/redraw.hpp"
#include "clca/store/trajectory.hpp"
#include "drawing/internal/frame_painter.hpp"
#include "drawing/space_time.hpp"

namespace clca::drawing {

class RunDrawing {
 public:
  /// Selects the frames; `max_bytes`: of memory, for the trajectory. Throws RedrawError,
  /// store::StoreError.
  RunDrawing(const RunToDraw& run, const RedrawOptions& options, double max_bytes);

  /// Upper ends of the scales of its pictures, by quantity and unit.
  using ScaleEnds = std::map<std::string, double>;
  ScaleEnds scale_ends() const;
  void set_scale_ends(const ScaleEnds& ends);  ///< `ends`: has at least the names of scale_ends()
  /// Name of the folder, such as `gate-15`.
  const std::string& name() const { return name_; }
  /// Shown above the pictures.
  void set_title(const std::string& title) { scene_.title = title; }

  /// Call before capture(). `tile_width`: see PictureUse. Throws scene::SceneError if the driver
  /// cannot draw the pictures.
  void prepare_painter(int tile_width = 0) {
    painter_.emplace(scene_, initial_, PictureUse{.for_pdf = pdf_, .tile_width = tile_width});
  }
  /// Gives the arrows of all pictures one scale, where the scene has none for them: that of the
  /// fastest picture.
  void unify_arrow_scale();
  CapturedFrame capture(std::size_t number);  ///< captures the picture of this number

  /// The frame of each picture; at the end of a stage, the first frame of the next stage.
  std::vector<store::Trajectory::Frame> picture_frames() const;
  /// Adds the frame of picture_frames() for a picture.
  void add_frame_to(SpaceTimePainter& space_time, std::size_t number);

  /// A note for the user on the choice of the frames; may be empty.
  const std::string& frame_choice_note() const { return note_; }
  const scene::Scene& scene() const { return scene_; }
  const grains::State& initial_state() const { return initial_; }
  FramePainter& painter() { return *painter_; }
  const FramePainter& painter() const { return *painter_; }
  std::size_t picture_count() const { return chosen_.size(); }
  std::uint64_t step_of_picture(std::size_t number) const;

 private:
  std::size_t first_frame(std::size_t stage) const;
  std::size_t last_frame_of_step(std::size_t frame) const;
  void begin_stage(std::size_t stage);
  /// Begins the window of velocities with the picture before, drawn or not, as the run does.
  void begin_window(std::size_t frame);
  /// Calls `show` with the content of a picture, taken from a frame.
  template <class Show>
  void visit_content(std::size_t number, std::size_t frame, Show show);

  std::string name_;
  scene::Scene scene_;
  grains::State initial_;
  store::Trajectory trajectory_;
  std::vector<std::size_t> run_pictures_;  // frames, with `every` of the scene
  std::vector<std::size_t>
      chosen_;  // frames that are drawn: of run_pictures_, also the first of a stage or the nearest
  std::vector<contact::Vessel> vessels_;  // by stage, at its start
  std::string note_;
  bool pdf_;
  std::optional<FramePainter> painter_;
  std::optional<std::size_t> stage_;
  std::uint64_t stage_start_ = 0;  // step
  PictureHistory history_;
};

/// Selected indices into `frames`, ascending. Each stage begins and ends with a picture, the others
/// are at least `every` steps apart. A step shared by two stages is drawn once, as the end of the
/// first.
std::vector<std::size_t> chosen_frames(const std::vector<store::Trajectory::Frame>& frames,
                                       std::uint64_t every);

/// Whether item `number` of `count` is among at most `most` (two or more) evenly spaced ones,
/// including first and last.
bool is_evenly_chosen(std::size_t number, std::size_t count, std::size_t most);

}  // namespace clca::drawing
