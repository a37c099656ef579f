#pragma once
// Overlaps of a stage, averaged over steps; distribution of forces, walls that are stalled.

#include <optional>
#include <vector>

#include "clca/contact/force.hpp"
#include "clca/measure/force.hpp"
#include "clca/measure/force_distribution.hpp"
#include "record/internal/observer.hpp"

namespace clca::record {

/// True if some wall of the scene moves and may overlap particles.
bool has_overlaps(const scene::Scene& scene);

class ForceRecord : public SavedObserver<ForceRecord> {
 public:
  /// With scene::Output::contacts, contacts are averaged over time.
  explicit ForceRecord(const scene::Scene& scene) : sampling_(scene.output.contacts) {}

  void after_step(const StageView& now) override;

  /// Distribution of the averages if contacts are sampled, else of the present overlaps.
  std::optional<measure::ForceDistribution> distribution(
      const std::vector<measure::OverlapContact>& contacts) const;
  const measure::ForceAverage& average() const { return average_; }

  /// False if this cannot have been recorded in a run that reached `now`.
  bool precedes(const grains::State& now) const { return average_.precedes(now); }
  static constexpr const char* kPath = "records/forces";
  CLCA_FIELDS(average_);

 private:
  void prepare(const StageView& /*now*/) override { average_ = {}; }

  std::optional<scene::Contacts> sampling_;
  measure::ForceAverage average_;
};

/// Of the normal forces between grains; none without any.
std::optional<measure::ForceDistribution> distribution(const std::vector<contact::Force>& forces);

/// One line per stalled wall: since when, its travel, its overlaps.
std::vector<std::string> stall_lines(const scene::Scene& scene, const model::SceneModel& model,
                                     const std::vector<double>& surface_at_start);

}  // namespace clca::record
