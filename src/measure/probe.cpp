#include "clca/measure/probe.hpp"

#include "measure/internal/sites.hpp"
#include "measure/numbers.hpp"

namespace clca::measure {

std::vector<double> fillings(const grains::State& state,
                             std::span<const lattice::Rectangle> regions) {
  const lattice::Lattice& lattice = state.lattice;
  std::vector<bool> wall(lattice.index_count(), false);
  for (const lattice::Site site : wall_sites(state)) {
    wall[lattice.index(site)] = true;
  }
  std::vector<bool> covered(lattice.index_count(), false);  // a site may have two owners
  for_each_site(state, [&](lattice::Site site) { covered[lattice.index(site)] = true; });
  std::vector<double> shares;
  for (const lattice::Rectangle& region : regions) {
    double free = 0;
    double filled = 0;
    for (const lattice::Site site : lattice::sites_in(lattice, region)) {
      const std::size_t index = lattice.index(site);
      free += wall[index] ? 0 : 1;
      filled += covered[index] && !wall[index] ? 1 : 0;
    }
    shares.push_back(free > 0 ? filled / free : 0);
  }
  return shares;
}

std::optional<RegionMotion> motion_in(const lattice::Rectangle& region,
                                      const std::vector<Displacement>& displacements,
                                      double steps) {
  const RegionMotion motion =
      motions_by_region(displacements, steps, 1,
                        [&](const Eigen::Vector2d& point, const auto& visit) {
                          if (region.contains(point)) {
                            visit(0, 1.0);
                          }
                        })
          .front();
  return motion.particles > 0 ? std::optional(motion) : std::nullopt;
}

double downward_flow(const Snapshot& before, const grains::State& now,
                     const lattice::Rectangle& region) {
  const double middle = (region.bottom + region.top) / 2;
  const auto is_below = [=](double y) { return y < middle - kRounding; };
  double flow = 0;
  for (std::size_t id = 0; id < now.particles.size(); ++id) {
    const std::optional<Displacement> path = before.path(now, id);
    const double end = path ? path->from.y() + path->vector.y() : 0;
    if (!path || is_below(path->from.y()) == is_below(end)) {
      continue;
    }
    const double share = (middle - path->from.y()) / path->vector.y();
    const double x = now.lattice.in_box(path->from + share * path->vector).x();
    if (x >= region.left && x < region.right) {
      flow += is_below(end) ? path->sites : -path->sites;
    }
  }
  return flow;
}

}  // namespace clca::measure
