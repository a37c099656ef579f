#include "clca/measure/field_grid.hpp"

#include "measure/internal/sites.hpp"
#include "measure/numbers.hpp"

namespace clca::measure {

namespace {

using grains::State;

/// Share of the sites of each cell taken by particles; wall sites count as sites.
std::vector<double> packing_of(const State& state, const Grid& grid) {
  const lattice::Lattice& lattice = state.lattice;
  std::vector<bool> taken(lattice.index_count(), false);  // a site may have two owners
  for_each_site(state, [&](lattice::Site site) { taken[lattice.index(site)] = true; });
  std::vector<double> filled(grid.size(), 0.0);
  std::vector<double> all(grid.size(), 0.0);
  for (int column = 0; column < lattice.columns(); ++column) {
    for (int row = 0; row < lattice.rows(); ++row) {
      const lattice::Site site = {column, row};
      grid.share_out(lattice::position(site), [&](std::size_t cell, double share) {
        filled[cell] += taken[lattice.index(site)] ? share : 0;
        all[cell] += share;
      });
    }
  }
  for (std::size_t cell = 0; cell < filled.size(); ++cell) {
    filled[cell] /= all[cell] > 0 ? all[cell] : 1;
  }
  return filled;
}

/// Mean velocity and granular temperature of the particles that start in each of several regions.
/// Of `regions` regions: `share_out(point, visit)` calls visit(region, share) for each that has a
/// point or a share of it. All is 0 where no particle starts. Lattice spacings per step.
/// Two passes: the difference of two means would not be exactly 0 where all particles move alike.
template <class ShareOut>
std::vector<RegionMotion> motions_by_region(const std::vector<Displacement>& displacements,
                                            double steps, std::size_t regions, ShareOut share_out) {
  std::vector<RegionMotion> motions(regions);
  std::vector<double> sites(regions, 0.0);
  for (const Displacement& displacement : displacements) {
    share_out(displacement.from, [&](std::size_t region, double share) {
      sites[region] += share * displacement.sites;
      motions[region].particles += share;
      motions[region].velocity += share * displacement.sites * displacement.vector / steps;
    });
  }
  for (std::size_t region = 0; region < regions; ++region) {
    motions[region].velocity /= sites[region] > 0 ? sites[region] : 1;
  }
  for (const Displacement& displacement : displacements) {
    share_out(displacement.from, [&](std::size_t region, double share) {
      RegionMotion& motion = motions[region];
      const Eigen::Vector2d deviation = displacement.vector / steps - motion.velocity;
      motion.fluctuation +=
          0.5 * deviation.squaredNorm() * share * displacement.sites / sites[region];
    });
  }
  return motions;
}

}  // namespace

Fields FieldWindow::fields(const State& now, double cell) const {
  const Grid grid(now.lattice, cell);
  Fields fields{.columns = grid.columns(), .rows = grid.rows()};
  fields.cells.resize(grid.size());
  const std::vector<double> packing = packing_of(now, grid);
  const std::uint64_t steps = now.step - begin_.step();
  const std::vector<RegionMotion> motions = motions_by_region(
      begin_.displacements(now), steps > 0 ? static_cast<double>(steps) : 1, grid.size(),
      [&](const Eigen::Vector2d& point, const auto& visit) { grid.share_out(point, visit); });
  for (std::size_t index = 0; index < grid.size(); ++index) {
    fields.cells[index] = {motions[index], grid.centre(index), packing[index]};
  }
  return fields;
}

double fluctuation_energy(const Fields& fields) {
  double sum = 0;
  double particles = 0;
  for (const FieldCell& cell : fields.cells) {
    sum += cell.fluctuation * cell.particles;
    particles += cell.particles;
  }
  return particles > 0 ? sum / particles : 0;
}

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
