#pragma once
// Overlaps of a stage: pairs, strengths and averages over steps.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "clca/measure/force.hpp"
#include "clca/measure/force_distribution.hpp"
#include "clca/scene/scene.hpp"
#include "run/model.hpp"

namespace clca::run {

class ForceRecord {
 public:
  /// With `sampling`, contacts are averaged over time.
  explicit ForceRecord(const std::optional<scene::Contacts>& sampling) : sampling_(sampling) {}

  void begin_stage() { average_ = {}; }
  /// Call after each step.
  void after_step(const Model& model, std::uint64_t steps_in_stage);

  /// Distribution of the averages if contacts are sampled, else of the present overlaps.
  std::optional<measure::ForceDistribution> distribution(
      const std::vector<measure::OverlapContact>& contacts) const;

  /// Columns: first, second (particle ids; the name of a wall), x, y, sites, depth, source (wall),
  /// mean_sites, share (of the samples; both empty without sampling). Contacts that were there in
  /// some sample but are gone have no place.
  std::string contacts_csv(const scene::Scene& scene,
                           const std::vector<measure::OverlapContact>& contacts) const;

  /// False if this cannot have been recorded in a run that reached `now`.
  bool precedes(const grains::State& now) const { return average_.precedes(now); }
  static constexpr auto fields() {
    return std::make_tuple(reflection::field("average", &ForceRecord::average_));
  }

 private:
  std::optional<scene::Contacts> sampling_;
  measure::ForceAverage average_;
};

/// Columns: low, high (sites), count, density (of f/<f>).
std::string distribution_csv(const std::optional<measure::ForceDistribution>& distribution);

/// Columns: id, species, x, y (centre of mass), sites (shared, in all contacts), pushes (onto it),
/// for each particle that overlaps.
std::string loads_csv(const scene::Scene& scene, const grains::State& state,
                      const std::vector<measure::OverlapContact>& contacts);

/// Columns: wall, travel (sites), depth (spacings under the surface at the start of the stage),
/// stalled_since (step), stalls, particles, sites, chain_sites, jammed.
std::string wall_overlaps_csv(const scene::Scene& scene, const grains::State& state,
                              const measure::ForceSummary& summary,
                              const std::vector<double>& surface_at_start);

}  // namespace clca::run
