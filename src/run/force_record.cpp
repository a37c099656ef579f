#include "run/force_record.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>

#include "clca/store/table.hpp"

namespace clca::run {

namespace {

constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

using Pair = std::pair<std::uint32_t, grains::Owner>;

std::string name_of(const scene::Scene& scene, grains::Owner owner) {
  return grains::is_particle(owner) ? fmt::format("{}", owner)
                                    : scene.walls[grains::wall_number(owner)].name;
}

}  // namespace

void ForceRecord::after_step(const Model& model, std::uint64_t steps_in_stage) {
  if (sampling_ && steps_in_stage % sampling_->every == 0) {
    average_.add(measure::contacts(model.state(), model.grains().occupancy()));
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

std::string ForceRecord::contacts_csv(const scene::Scene& scene,
                                      const std::vector<measure::OverlapContact>& contacts) const {
  struct Row {
    const measure::OverlapContact* now = nullptr;
    double mean_sites = kNothing;
    double share = kNothing;
  };
  std::map<Pair, Row> rows;
  for (const measure::OverlapContact& contact : contacts) {
    rows[{contact.first, contact.second}].now = &contact;
  }
  for (const measure::ForceAverage::Mean& mean : average_.means()) {
    Row& row = rows[{mean.first, mean.second}];
    row.mean_sites = mean.sites;
    row.share = mean.share;
  }
  store::Table table(
      {"first", "second", "x", "y", "sites", "depth", "source", "mean_sites", "share"});
  for (const auto& [pair, row] : rows) {
    const measure::OverlapContact* now = row.now;
    const std::string source =
        now != nullptr && now->source ? scene.walls[*now->source].name : std::string();
    table.add_row({std::uint64_t{pair.first}, name_of(scene, pair.second),
                   now != nullptr ? now->point.x() : kNothing,
                   now != nullptr ? now->point.y() : kNothing,
                   static_cast<std::uint64_t>(now != nullptr ? now->sites : 0),
                   static_cast<std::uint64_t>(now != nullptr ? now->depth : 0), source,
                   row.mean_sites, row.share});
  }
  return table.to_csv();
}

std::string distribution_csv(const std::optional<measure::ForceDistribution>& distribution) {
  store::Table table({"low", "high", "count", "density"});
  if (distribution) {
    for (const measure::ForceBin& bin : distribution->bins) {
      table.add_row({bin.low, bin.high, std::uint64_t{bin.count}, bin.density});
    }
  }
  return table.to_csv();
}

std::string loads_csv(const scene::Scene& scene, const grains::State& state,
                      const std::vector<measure::OverlapContact>& contacts) {
  const std::vector<double> sites = measure::force_indices(state.particles.size(), contacts);
  std::vector<std::uint64_t> pushes(state.particles.size(), 0);
  for (const grains::Push& push : state.pushes) {
    ++pushes[push.pushed];
  }
  store::Table table({"id", "species", "x", "y", "sites", "pushes"});
  for (std::size_t id = 0; id < sites.size(); ++id) {
    if (sites[id] > 0) {
      const grains::Particle& particle = state.particles[id];
      const Eigen::Vector2d centre = grains::centre_in_box(state, particle);
      table.add_row({std::uint64_t{id}, scene.species[state.kinds[particle.kind].species].name,
                     centre.x(), centre.y(), sites[id], pushes[id]});
    }
  }
  return table.to_csv();
}

std::string wall_overlaps_csv(const scene::Scene& scene, const grains::State& state,
                              const measure::ForceSummary& summary,
                              const std::vector<double>& surface_at_start) {
  store::Table table({"wall", "travel", "depth", "stalled_since", "stalls", "particles", "sites",
                      "chain_sites", "jammed"});
  for (const measure::WallForce& wall : summary.walls) {
    const auto depth = measure::penetration(state, state.walls[wall.wall], surface_at_start);
    table.add_row(
        {scene.walls[wall.wall].name, static_cast<double>(wall.travel), depth.value_or(kNothing),
         wall.stalled_since ? static_cast<double>(*wall.stalled_since) : kNothing, wall.stalls,
         std::uint64_t{wall.particles}, wall.sites, wall.chain_sites, std::uint64_t{wall.jammed}});
  }
  return table.to_csv();
}

}  // namespace clca::run
