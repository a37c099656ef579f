#include "run/force_measures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace clca::run {

namespace {

/// Whether a wall is stalled: it is due to move and blocked.
bool is_stalled(const grains::Wall& wall) {
  return wall.present && wall.travel.active && wall.travel.stalled_since &&
         !grains::is_over(*wall.motion, wall.travel);
}

/// Combined results of several walls; none if there are none.
struct CombinedWalls {
  std::optional<double> depth;          // of the deepest, lattice spacings
  std::optional<double> stalled_since;  // of the first to stall, step
};

CombinedWalls combined(const grains::State& state, const measure::ForceSummary& summary,
                       const std::vector<double>& surface_at_start) {
  CombinedWalls result;
  for (const measure::WallForce& wall : summary.walls) {
    const grains::Wall& one = state.walls[wall.wall];
    if (!one.present) {
      continue;
    }
    const auto depth = measure::penetration(state, one, surface_at_start);
    if (depth && one.lets_overlap()) {
      result.depth = std::max(result.depth.value_or(*depth), *depth);
    }
    if (is_stalled(one)) {
      const auto step = static_cast<double>(*wall.stalled_since);
      result.stalled_since = std::min(result.stalled_since.value_or(step), step);
    }
  }
  return result;
}

}  // namespace

void add_force(std::vector<store::NamedMeasure>& results, const Model& model,
               const std::vector<double>& surface_at_start, const ForceRecord& record) {
  const grains::State& state = model.state();
  const auto contacts = measure::contacts(state, model.grains().occupancy());
  const auto summary = measure::force_summary(state, model.grains().occupancy(), contacts);
  const auto distribution = record.distribution(contacts);
  const CombinedWalls walls = combined(state, summary, surface_at_start);
  const auto add = [&](const char* name, const store::MeasureValue& value) {
    results.emplace_back(name, value);
  };
  add("overlap_depth_max", static_cast<double>(summary.depth_max));
  add("overlap_sites", static_cast<double>(summary.sites));
  add("overlap_contacts", static_cast<double>(summary.contacts));
  add("overlap_cone_share", store::value_or_null(summary.cone_share));
  add("jammed", static_cast<double>(summary.jammed));
  add("force_share_above_mean",
      distribution ? store::MeasureValue(distribution->share_above_mean) : store::MeasureValue());
  add("force_tail_beta",
      distribution ? store::value_or_null(distribution->beta) : store::MeasureValue());
  add("plate_depth", store::value_or_null(walls.depth));
  add("stalled_since", store::value_or_null(walls.stalled_since));
}

std::vector<std::string> stall_lines(const scene::Scene& scene, const Model& model,
                                     const std::vector<double>& surface_at_start) {
  const grains::State& state = model.state();
  const auto contacts = measure::contacts(state, model.grains().occupancy());
  std::vector<std::string> lines;
  for (const measure::WallForce& wall :
       measure::force_summary(state, model.grains().occupancy(), contacts).walls) {
    const grains::Wall& one = state.walls[wall.wall];
    if (!is_stalled(one)) {
      continue;
    }
    std::string line = fmt::format("wall {} stalls since step {} after {} sites",
                                   scene.walls[wall.wall].name, *wall.stalled_since, wall.travel);
    if (one.lets_overlap()) {
      const auto depth = measure::penetration(state, one, surface_at_start);
      line += depth && *depth > 0 ? fmt::format(", {:.1f} spacings deep", *depth) : "";
      line +=
          fmt::format(": {} sites overlap, {} particles are jammed", wall.chain_sites, wall.jammed);
    }
    lines.push_back(line);
  }
  return lines;
}

}  // namespace clca::run
