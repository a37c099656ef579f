#include "run/force_record.hpp"

#include <algorithm>

namespace clca::run {

bool has_overlaps(const scene::Scene& scene) {
  return std::any_of(scene.walls.begin(), scene.walls.end(), [](const scene::Wall& wall) {
    return wall.motion && wall.passive == grains::Passive::overlap;
  });
}

void ForceRecord::after_step(const StageView& now) {
  if (sampling_ && now.history.steps % sampling_->every == 0) {
    average_.add(measure::contacts(now.model.state(), now.model.grains().occupancy()));
  }
}

std::optional<measure::ForceDistribution> ForceRecord::distribution(
    const std::vector<measure::OverlapContact>& contacts) const {
  if (sampling_) {
    return measure::force_distribution(measure::strengths(average_.means()),
                                       measure::Strength::averaged);
  }
  return measure::force_distribution(measure::strengths(contacts), measure::Strength::whole_sites);
}

ObserverKind overlaps_observer() {
  return observer_kind<ForceRecord>(has_overlaps);
}

}  // namespace clca::run
