// Measures of forces between grains, and of walls that push grains and are stalled.

#include "record/forces.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "record/internal/contact_record.hpp"
#include "record/internal/quantities.hpp"

namespace clca::record {

bool has_overlaps(const scene::Scene& scene) {
  return std::ranges::any_of(scene.walls, [](const scene::Wall& wall) {
    return wall.motion && wall.passive_rule == grains::PassiveRule::overlap;
  });
}

std::optional<measure::ForceDistribution> normal_force_distribution(
    const std::vector<contact::Force>& forces) {
  std::vector<double> strengths;
  for (const contact::Force& force : forces) {
    if (grains::is_particle(force.other) && force.normal_force > 0) {
      strengths.push_back(force.normal_force);
    }
  }
  return measure::force_distribution(strengths, measure::StrengthKind::averaged);
}

namespace {

/// Whether a wall is stalled: it is due to move and blocked.
bool is_stalled(const grains::Wall& wall) {
  return wall.present && wall.travel.active && wall.travel.stalled_since &&
         !grains::is_over(*wall.motion, wall.travel);
}

constexpr Quantity kShareAboveMean = {"force_share_above_mean", "Contacts above the mean force", "",
                                      "their share"};
constexpr Quantity kTailBeta = {"force_tail_beta", "Tail of the forces, β", "",
                                "of exp(-β f/⟨f⟩), which the forces above the mean f follow"};

MeasureValues values_of(const std::optional<measure::ForceDistribution>& distribution) {
  return distribution ? MeasureValues{distribution->share_above_mean,
                                      store::value_or_null(distribution->beta)}
                      : MeasureValues(2);
}

/// Measures of the forces between touching grains.
MeasureValues contact_forces(const StageView& stage) {
  const auto* contacts = stage.observers.find<ContactRecord>();
  if (contacts == nullptr) {
    return {};
  }
  const std::vector<contact::Force> forces = contacts->stage_mean_forces(stage.model);
  const grains::State& state = stage.model.state();
  const auto grains = static_cast<double>(grains::present_count(state));
  double touching = 0;  // bodies of contacts that are grains, mean over the steps
  double floor = 0;
  for (const contact::Force& force : forces) {
    touching += force.share * (grains::is_particle(force.other) ? 2 : 1);
    floor += force.other == contact::kFloor ? force.on_upper().y() : 0;
  }
  const std::vector<double> residuals =
      contact::force_residuals(state, forces, gravity_direction(stage.model.vessel()));
  const double residual = std::accumulate(residuals.begin(), residuals.end(), 0.0);
  const auto per_grain = [&](double sum) {
    return grains > 0 ? store::MeasureValue(sum / grains) : store::MeasureValue();
  };
  const MeasureValues shape = values_of(normal_force_distribution(forces));
  return {per_grain(touching), shape[0], shape[1], per_grain(residual), per_grain(floor)};
}

/// Measures of walls that overlap grains.
MeasureValues overlap_forces(const StageView& stage) {
  const auto* overlaps = stage.observers.find<OverlapRecord>();
  if (overlaps == nullptr) {
    return {};
  }
  const grains::State& state = stage.model.state();
  const grains::Occupancy& occupancy = stage.model.grains().occupancy();
  const auto contacts = measure::overlap_contacts(state, occupancy);
  const auto summary = measure::force_summary(state, occupancy, contacts);
  const MeasureValues shape = values_of(overlaps->distribution(contacts));
  std::optional<double> depth;          // of the deepest wall
  std::optional<double> stalled_since;  // of the first to stall
  for (const measure::WallOverlap& overlap : summary.walls) {
    const grains::Wall& wall = state.walls[overlap.wall];
    const auto of_wall = measure::penetration_depth(state, wall, stage.history.profile_at_start);
    if (of_wall && wall.lets_overlap()) {
      depth = std::max(depth.value_or(*of_wall), *of_wall);
    }
    if (is_stalled(wall)) {
      const auto step = static_cast<double>(*overlap.stalled_since);
      stalled_since = std::min(stalled_since.value_or(step), step);
    }
  }
  return {static_cast<double>(summary.max_depth),
          static_cast<double>(summary.shared_sites),
          static_cast<double>(summary.contact_count),
          store::value_or_null(summary.cone_share),
          static_cast<double>(summary.jammed_particles),
          shape[0],
          shape[1],
          store::value_or_null(depth),
          store::value_or_null(stalled_since)};
}

}  // namespace

ObserverFactory overlaps_observer() {
  return observer_factory<OverlapRecord>(has_overlaps);
}

std::vector<QuantityGroup> force_quantities() {
  using scene::Measure;
  return {
      {Measure::force,
       "model `contact`",
       {{"contacts_per_grain", "Contacts of a grain", "", "with grains and walls, mean"},
        kShareAboveMean,
        kTailBeta,
        {"balance_residual", "Balance of forces", "",
         "what forces and weight do not balance, over the weight; mean over grains"},
        {"load_floor", "Load on the floor", "",
         "force on the floor of the box over the weight of all grains", true}},
       contact_forces},
      {Measure::force,
       "with a plate or piston",
       {{"overlap_depth_max", "Deepest overlap", "moves",
         "moves that the deepest overlap would take back"},
        {"overlap_sites", "Overlap", "sites", "shared by all pairs that overlap"},
        {"overlap_contacts", "Pairs that overlap", "", ""},
        {"overlap_cone_share", "Overlap in the cone", "",
         "share of the sites within 45° ahead of the wall that pushed"},
        {"jammed", "Jammed", "particles", "pushed and at rest"},
        kShareAboveMean,
        kTailBeta,
        {"plate_depth", "Depth of the plate", "spacings",
         "of the deepest plate under the surface at the start of the stage"},
        {"stalled_since", "Stalled since", "step", "since when a wall wants to go on and cannot"}},
       overlap_forces}};
}

std::vector<std::string> stall_messages(const scene::Scene& scene, const model::SceneModel& model,
                                        const std::vector<double>& surface_at_start) {
  const grains::State& state = model.state();
  const auto contacts = measure::overlap_contacts(state, model.grains().occupancy());
  std::vector<std::string> lines;
  for (const measure::WallOverlap& overlap :
       measure::force_summary(state, model.grains().occupancy(), contacts).walls) {
    const grains::Wall& wall = state.walls[overlap.wall];
    if (!is_stalled(wall)) {
      continue;
    }
    std::string line =
        fmt::format("wall {} stalls since step {} after {} sites", scene.walls[overlap.wall].name,
                    *overlap.stalled_since, overlap.travel);
    if (wall.lets_overlap()) {
      const auto depth = measure::penetration_depth(state, wall, surface_at_start);
      line += depth && *depth > 0 ? fmt::format(", {:.1f} spacings deep", *depth) : "";
      line += fmt::format(": {} sites overlap, {} particles are jammed", overlap.chain_sites,
                          overlap.jammed_particles);
    }
    lines.push_back(line);
  }
  return lines;
}

}  // namespace clca::record
