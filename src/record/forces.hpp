#pragma once
// Forces between grains, and of walls that push grains, as a stage gathers them.

#include <optional>
#include <vector>

#include "clca/contact/force.hpp"
#include "clca/measure/force.hpp"
#include "record/internal/observer.hpp"

namespace clca::record {

/// True if some wall of the scene moves and may overlap particles.
bool has_overlaps(const scene::Scene& scene);

/// Overlaps of a stage, averaged over steps.
class OverlapRecord : public SavedObserver<OverlapRecord> {
 public:
  /// Averages contacts over time if the scene has Output::contacts.
  explicit OverlapRecord(const scene::Scene& scene) : sampling_(scene.output.contacts) {}

  void after_step(const StageView& now) override {
    if (sampling_ && now.history.steps % sampling_->every == 0) {
      average_.add(measure::overlap_contacts(now.model.state(), now.model.grains().occupancy()));
    }
  }

  /// Distribution of the averages if contacts are sampled, else of the present overlaps.
  std::optional<measure::ForceDistribution> distribution(
      const std::vector<measure::OverlapContact>& contacts) const {
    return sampling_ ? measure::force_distribution(measure::strengths(average_.means()),
                                                   measure::StrengthKind::averaged)
                     : measure::force_distribution(measure::strengths(contacts),
                                                   measure::StrengthKind::whole_sites);
  }
  const measure::ForceAverage& average() const { return average_; }

  bool precedes(const grains::State& now) const { return average_.precedes(now); }
  static constexpr const char* kPath = "records/forces";
  CLCA_FIELDS(average_);

 private:
  void prepare(const StageView& /*now*/) override { average_ = {}; }

  std::optional<scene::ContactSampling> sampling_;
  measure::ForceAverage average_;
};

/// Distribution of the normal forces between grains; none without any.
std::optional<measure::ForceDistribution> normal_force_distribution(
    const std::vector<contact::Force>& forces);

}  // namespace clca::record
