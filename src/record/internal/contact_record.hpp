#pragma once
// Mean forces of the contact model over the last steps.

#include <vector>

#include "clca/contact/force.hpp"
#include "record/internal/observer.hpp"

namespace clca::record {

/// A window over the last steps, kept as two blocks: the current and the previous one.
class ForceWindow {
 public:
  /// Adds a step, with the mean mass of its grains. The window holds the last `most` / 2 to `most`
  /// steps.
  void add(const std::vector<contact::Force>& forces, double mean_mass, std::uint64_t most);
  bool is_empty() const { return block_.steps == 0; }
  /// In weights of a grain of this mass.
  std::vector<contact::Force> means(double mean_mass) const;

  /// False if a contact is not between two bodies of `state`, or a number is not finite.
  bool belongs_to(const grains::State& state) const;
  CLCA_FIELDS(before_, block_);

 private:
  contact::ForceSums before_;  // of the previous block
  contact::ForceSums block_;   // of the current one
};

/// Mean forces before the end of a stage, each picture and each trajectory frame that shows forces.
/// Costs nothing in steps that none of them needs.
class ContactRecord : public SavedObserver<ContactRecord> {
 public:
  explicit ContactRecord(const scene::Scene& scene);
  static double bytes(const scene::Scene& scene, double particles);

  void after_step(const StageView& now) override;

  /// Means over the last steps of the stage; the forces of the last step if there are none.
  std::vector<contact::Force> stage_mean_forces(const model::SceneModel& model) const;
  /// Mean forces of present contacts before the picture or frame due now; else stage_mean_forces().
  std::vector<contact::Force> shown_forces(const model::SceneModel& model) const;

  bool precedes(const grains::State& now) const {
    return stage_.belongs_to(now) && last_step_.belongs_to(now) &&
           pictures_.window.belongs_to(now) && frames_.window.belongs_to(now);
  }
  static constexpr const char* kPath = "records/contacts";
  CLCA_FIELDS(stage_, last_step_, pictures_, frames_);

 private:
  /// An event every so many steps of a stage, and the window of steps before it.
  struct Recurring {
    std::uint64_t every = 0;  // 0: never
    ForceWindow window = {};
    bool due = false;

    void begin_step(std::uint64_t steps_in_stage);
    bool is_due_within(std::uint64_t steps, std::uint64_t steps_in_stage) const;
    CLCA_FIELDS(window, due);
  };

  void prepare(const StageView& now) override;

  scene::ContactSampling sampling_;
  std::uint64_t most_;  // samples in a window
  bool has_tables_;
  ForceWindow stage_;      // the last steps of the stage
  ForceWindow last_step_;  // where the window of the stage has no sample yet
  Recurring pictures_;
  Recurring frames_;
};

/// Bytes of a frame of the contact model, with forces or without; 0 for other models.
double frame_bytes(const scene::Scene& scene, bool has_forces, double particles);

}  // namespace clca::record
