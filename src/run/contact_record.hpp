#pragma once
// Forces of the contact model as means over the last steps.

#include <string>
#include <vector>

#include "clca/contact/force.hpp"
#include "clca/scene/scene.hpp"
#include "run/model.hpp"

namespace clca::run {

/// The last steps, up to a number of them: those of the present block and of the one before.
class ForceWindow {
 public:
  void clear() { *this = {}; }
  /// Adds a step; the window holds `most` of them at most, and more than half of that once there
  /// were so many.
  void add(const std::vector<contact::Force>& forces, std::uint64_t most);
  bool is_empty() const { return block_.steps == 0; }
  std::vector<contact::Force> means() const;

  /// False where a contact is not one of two bodies of `state`, or a number is not finite.
  bool is_of(const grains::State& state) const;
  static constexpr auto fields() {
    using fields::field;
    return std::make_tuple(field("before", &ForceWindow::before_),
                           field("block", &ForceWindow::block_));
  }

 private:
  contact::ForceSums before_;
  contact::ForceSums block_;
};

/// The steps before the end of a stage, before each picture and before each frame of a trajectory
/// that show forces. Costs nothing in steps that none of these needs.
class ContactRecord {
 public:
  explicit ContactRecord(const scene::Scene& scene);

  void begin_stage();
  /// Call after each step, which left `report`.
  void after_step(const scene::Stage& stage, const Model& model, const Model::Report& report,
                  std::uint64_t steps_in_stage);

  /// Means over the last steps of the stage, as it ends now; where there were none of them, the
  /// forces of the last step.
  std::vector<contact::Force> at_end(const Model& model) const;
  /// Means over the last steps before a picture that is due now; else as at_end().
  /// Without grains that have left.
  std::vector<contact::Force> of_picture(const Model& model) const;
  /// The same of a frame of the trajectory: those of a picture where one is drawn that shows
  /// forces, or may be as the stage ends.
  std::vector<contact::Force> of_frame(const Model& model) const;

  /// False where this was not recorded in a run that has come to `now`.
  bool precedes(const grains::State& now) const {
    return stage_.is_of(now) && pictures_.window.is_of(now) && frames_.window.is_of(now);
  }
  static constexpr auto fields() {
    using fields::field;
    return std::make_tuple(field("stage", &ContactRecord::stage_),
                           field("pictures", &ContactRecord::pictures_),
                           field("frames", &ContactRecord::frames_));
  }

 private:
  /// What comes every so many steps of a stage, and the steps before it.
  struct Recurring {
    std::uint64_t every = 0;  // 0: never
    ForceWindow window = {};
    bool due = false;

    void begin_step(std::uint64_t steps_in_stage);
    bool is_due_within(std::uint64_t steps, std::uint64_t steps_in_stage) const;
    static constexpr auto fields() {
      return std::make_tuple(fields::field("window", &Recurring::window),
                             fields::field("due", &Recurring::due));
    }
  };

  std::vector<contact::Force> forces_of(const Recurring& recurring, const Model& model) const;

  scene::Contacts sampling_;
  std::uint64_t most_;  // samples in a window
  bool has_tables_;
  ForceWindow stage_;
  Recurring pictures_;
  Recurring frames_;
};

/// Whether the pictures of a scene of the contact model show forces.
bool pictures_show_forces(const scene::Scene& scene);

}  // namespace clca::run
