#include "clca/measure/probe.hpp"

#include <algorithm>

#include "measure/particle_sites.hpp"
#include "measure/wall_sites.hpp"

namespace clca::measure {

double filling(const grains::State& state, const lattice::Rectangle& region) {
  std::vector<lattice::Site> sites = lattice::sites_in(state.lattice, region);
  std::sort(sites.begin(), sites.end());
  const std::vector<lattice::Site> walls = wall_sites(state);
  std::vector<lattice::Site> free;
  std::set_difference(sites.begin(), sites.end(), walls.begin(), walls.end(),
                      std::back_inserter(free));
  std::vector<bool> covered(free.size(), false);  // a site may have two owners
  for_each_site(state, [&](lattice::Site site) {
    if (region.contains(lattice::position(site))) {
      const auto place = std::lower_bound(free.begin(), free.end(), site);
      if (place != free.end() && *place == site) {
        covered[static_cast<std::size_t>(place - free.begin())] = true;
      }
    }
  });
  const auto count = static_cast<double>(std::count(covered.begin(), covered.end(), true));
  return free.empty() ? 0 : count / static_cast<double>(free.size());
}

std::optional<RegionMotion> motion_in(const lattice::Rectangle& region,
                                      const std::vector<Displacement>& displacements,
                                      double steps) {
  RegionMotion motion;
  double sites = 0;
  for (const Displacement& displacement : displacements) {
    if (region.contains(displacement.from)) {
      ++motion.particles;
      sites += displacement.sites;
      motion.velocity += displacement.sites * displacement.vector / steps;
    }
  }
  if (motion.particles == 0) {
    return std::nullopt;
  }
  motion.velocity /= sites;
  for (const Displacement& displacement : displacements) {
    if (region.contains(displacement.from)) {
      const Eigen::Vector2d deviation = displacement.vector / steps - motion.velocity;
      motion.fluctuation += 0.5 * deviation.squaredNorm() * displacement.sites / sites;
    }
  }
  return motion;
}

double downward_flow(const Snapshot& before, const grains::State& now,
                     const lattice::Rectangle& region) {
  const double middle = (region.bottom + region.top) / 2;
  double flow = 0;
  for (std::size_t id = 0; id < now.particles.size(); ++id) {
    const grains::Particle& particle = now.particles[id];
    grains::Particle entered = particle;
    entered.column = now.origins[id].column;
    entered.row = now.origins[id].row;
    const std::optional<Eigen::Vector2d> from =
        before.knows(id) ? before.centre(id) : grains::centre(now, entered);
    const Eigen::Vector2d to = grains::centre(now, particle);
    if (!from || (from->y() < middle) == (to.y() < middle)) {
      continue;
    }
    const double share = (middle - from->y()) / (to.y() - from->y());
    const double x = in_box(now.lattice, *from + share * (to - *from)).x();
    if (x >= region.left && x < region.right) {
      const auto sites = static_cast<double>(now.shape(particle).size());
      flow += to.y() < middle ? sites : -sites;
    }
  }
  return flow;
}

}  // namespace clca::measure
