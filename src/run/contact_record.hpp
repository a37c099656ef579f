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

/// The steps before the end of a stage and before each picture. Costs nothing in steps that neither
/// needs.
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
  std::vector<contact::Force> of_picture(const Model& model) const;

  /// False where this was not recorded in a run that has come to `now`.
  bool precedes(const grains::State& now) const { return stage_.is_of(now) && picture_.is_of(now); }
  static constexpr auto fields() {
    using fields::field;
    return std::make_tuple(field("stage", &ContactRecord::stage_),
                           field("picture", &ContactRecord::picture_),
                           field("picture_due", &ContactRecord::picture_due_));
  }

 private:
  scene::Contacts sampling_;
  std::uint64_t most_;           // samples in a window
  std::uint64_t picture_every_;  // steps; 0: pictures show no forces
  bool has_tables_;
  ForceWindow stage_;
  ForceWindow picture_;
  bool picture_due_ = false;
};

/// Whether the pictures of a scene of the contact model show forces.
bool pictures_show_forces(const scene::Scene& scene);

}  // namespace clca::run
