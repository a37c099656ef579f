#include "clca/measure/field_grid.hpp"

#include <algorithm>

#include "clca/lattice/region.hpp"
#include "measure/places.hpp"

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

/// Equal lattice vectors differ by rounding only, others by half a spacing or more.
constexpr double kAtRest = 1e-9;  // square spacings

struct CellMotion {
  std::size_t particles = 0;
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();  // displacement
  double squares = 0;                              // sum of squared deviations from it

  bool is_sparse() const { return particles < FluctuationHistogram::kMinParticles; }
  bool is_resting() const { return squares < kAtRest; }
  bool is_counted() const { return !is_sparse() && !is_resting(); }
  /// Squared deviation of one particle, corrected for the mean being that of its own cell.
  double energy(const Displacement& displacement) const {
    const auto count = static_cast<double>(particles);
    return (displacement.vector - mean).squaredNorm() * count / (count - 1);
  }
};

std::vector<CellMotion> cell_motions(const std::vector<Displacement>& displacements,
                                     const Grid& grid) {
  std::vector<CellMotion> cells(grid.size());
  for (const Displacement& displacement : displacements) {
    CellMotion& cell = cells[grid.cell_at(displacement.from)];
    ++cell.particles;
    cell.mean += displacement.vector;
  }
  for (CellMotion& cell : cells) {
    cell.mean /= static_cast<double>(std::max<std::size_t>(cell.particles, 1));
  }
  for (const Displacement& displacement : displacements) {
    CellMotion& cell = cells[grid.cell_at(displacement.from)];
    cell.squares += (displacement.vector - cell.mean).squaredNorm();
  }
  return cells;
}

/// Half the mean squared deviation of displacements from the mean of their cell; 0 without cells.
double displacement_temperature(const std::vector<CellMotion>& cells) {
  double energies = 0;
  double particles = 0;
  for (const CellMotion& cell : cells) {
    if (cell.is_counted()) {
      const auto count = static_cast<double>(cell.particles);
      energies += cell.squares * count / (count - 1);
      particles += count;
    }
  }
  return particles > 0 ? energies / particles / 2 : 0;
}

/// Bin of a particle by the energies of its own cell.
/// For n normal particles its share of the sum of squares is beta distributed with parameters 1 and
/// n - 2, so that P(larger) = (1 - share)^(n - 2).
std::size_t local_bin(const CellMotion& cell, double energy) {
  const double rest = std::max(0.0, 1 - energy / cell.squares);
  double beyond = 1;  // by multiplication: the last bit of pow is not the same everywhere
  for (std::size_t i = 2; i < cell.particles; ++i) {
    beyond *= rest;
  }
  const auto bin = static_cast<std::size_t>((1 - beyond) * FluctuationHistogram::kBinCount);
  return std::min(bin, FluctuationHistogram::kBinCount - 1);
}

class Walls {
 public:
  explicit Walls(const grains::State& state) : state_(state), sites_(wall_mask(state)) {}

  /// The path of a force on a wall to the centre of the grain, against the normal: through the wall
  /// to its far side, or to that of the box behind it. The branch if it misses the wall.
  Eigen::Vector2d path(const contact::Force& force) const {
    constexpr double kStep = 1.0 / 16;  // lattice spacings
    const Eigen::Vector2d centre = force.point + force.branch;
    const auto at = [&](double length) { return Eigen::Vector2d(centre - length * force.normal); };
    const double reached = max_site_distance(state_.shape(state_.particles[force.upper])) + 1;
    double length = 0;
    while (length < reached && !is_wall(at(length))) {
      length += kStep;
    }
    if (length >= reached) {
      return force.branch;
    }
    const double most = distance_to_side(centre, force.normal);
    while (length < most && (is_wall(at(length)) || !is_inside(at(length)))) {
      length += kStep;
    }
    return std::min(length, most) * force.normal;
  }

 private:
  /// Whether the site of a point is such; or of two sites left and right of it, one.
  template <class Is>
  static bool at_site(const Eigen::Vector2d& point, const Is& is) {
    const Eigen::Vector2d aside(kRoundingTolerance, 0);
    return is(lattice::nearest_site(point - aside)) || is(lattice::nearest_site(point + aside));
  }
  bool is_inside(const Eigen::Vector2d& point) const {
    return at_site(point, [&](lattice::Site site) { return state_.lattice.contains(site); });
  }
  bool is_wall(const Eigen::Vector2d& point) const {
    return at_site(point, [&](lattice::Site site) {
      return state_.lattice.contains(site) && sites_[state_.lattice.index(site)];
    });
  }

  /// From a point to the side of the box, against the normal, in lattice spacings.
  double distance_to_side(const Eigen::Vector2d& point, const Eigen::Vector2d& normal) const {
    const Eigen::Vector2d low = lattice::Lattice::lower_left_corner();
    const Eigen::Vector2d high = low + state_.lattice.extent();
    double least = state_.lattice.extent().norm();
    for (const Eigen::Index axis : {0, 1}) {
      const double side = normal[axis] > 0 ? low[axis] : high[axis];
      if (normal[axis] != 0 && !(axis == 0 && state_.lattice.periodic())) {
        least = std::min(least, (point[axis] - side) / normal[axis]);
      }
    }
    return least;
  }

  const grains::State& state_;
  std::vector<bool> sites_;  // by index in the lattice
};

}  // namespace

std::vector<FieldCell> field_cells(const Snapshot& begin, const State& now, double cell) {
  const Grid grid(now.lattice, cell);
  std::vector<FieldCell> cells(grid.size());
  const std::vector<double> packing = packing_of(now, grid);
  const std::uint64_t steps = now.step - begin.step();
  const std::vector<RegionMotion> motions = motions_by_region(
      begin.displacements(now), steps > 0 ? static_cast<double>(steps) : 1, grid.size(),
      [&](const Eigen::Vector2d& point, const auto& visit) { grid.share_out(point, visit); });
  for (std::size_t index = 0; index < grid.size(); ++index) {
    cells[index] = {motions[index], grid.cell_centre(index), packing[index]};
  }
  return cells;
}

double mean_fluctuation(const std::vector<FieldCell>& cells) {
  double sum = 0;
  double particles = 0;
  for (const FieldCell& cell : cells) {
    sum += cell.fluctuation * cell.particles;
    particles += cell.particles;
  }
  return particles > 0 ? sum / particles : 0;
}

std::vector<double> filled_shares(const grains::State& state,
                                  std::span<const lattice::Rectangle> regions) {
  const lattice::Lattice& lattice = state.lattice;
  const std::vector<bool> wall = wall_mask(state);
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

std::optional<RegionMotion> region_motion(const lattice::Rectangle& region,
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

double sites_moved_down(const Snapshot& before, const grains::State& now,
                        const lattice::Rectangle& region) {
  const double middle = (region.bottom + region.top) / 2;
  const auto is_below = [=](double y) { return y < middle - kRoundingTolerance; };
  double flow = 0;
  for (std::size_t id = 0; id < now.particles.size(); ++id) {
    const std::optional<Displacement> path = before.displacement(now, id);
    const double end = path ? path->from.y() + path->vector.y() : 0;
    if (!path || is_below(path->from.y()) == is_below(end)) {
      continue;
    }
    const double share = (middle - path->from.y()) / path->vector.y();
    const double x = now.lattice.image_in_box(path->from + share * path->vector).x();
    if (x >= region.left && x < region.right) {
      flow += is_below(end) ? path->sites : -path->sites;
    }
  }
  return flow;
}

void FluctuationHistogram::add(const std::vector<Displacement>& displacements, const Grid& grid) {
  const std::vector<CellMotion> cells = cell_motions(displacements, grid);
  for (const CellMotion& cell : cells) {
    (cell.is_sparse() ? sparse_ : cell.is_resting() ? resting_ : samples_) += cell.particles;
  }
  const double scale = displacement_temperature(cells);
  for (const Displacement& displacement : displacements) {
    const CellMotion& cell = cells[grid.cell_at(displacement.from)];
    if (cell.is_counted()) {
      const double energy = cell.energy(displacement);
      ++counts_[bins_.bin_of(energy / scale)];
      ++local_counts_[local_bin(cell, energy)];
    }
  }
}

std::vector<double> FluctuationHistogram::shares_of(
    const std::vector<std::uint64_t>& counts) const {
  std::vector<double> shares(counts.size(), 0.0);
  for (std::size_t bin = 0; bin < counts.size() && samples_ > 0; ++bin) {
    shares[bin] = static_cast<double>(counts[bin]) / static_cast<double>(samples_);
  }
  return shares;
}

double FluctuationHistogram::share_of_all(std::uint64_t particles) const {
  const auto all = static_cast<double>(samples_ + resting_ + sparse_);
  return all > 0 ? static_cast<double>(particles) / all : 0;
}

std::vector<StressCell> stress_field(const grains::State& state,
                                     std::span<const contact::Force> forces, double cell) {
  const Grid grid(state.lattice, cell);
  const Walls walls(state);
  std::vector<StressCell> cells(grid.size());
  for (std::size_t i = 0; i < cells.size(); ++i) {
    cells[i].centre = grid.cell_centre(i);
  }
  for (const contact::Force& force : forces) {
    const bool with_grain = grains::is_particle(force.other);
    const Eigen::Vector2d centre = with_grain
                                       ? grains::centre_in_box(state, state.particles[force.upper])
                                       : Eigen::Vector2d(force.point + force.branch);
    const Eigen::Vector2d path =
        with_grain || contact::is_side(force.other) ? force.branch : walls.path(force);
    const Eigen::Vector2d on_upper = force.on_upper() / grid.cell_area();
    for (const Grid::PathPart& part : grid.path_parts(centre - path, path)) {
      StressCell& sum = cells[part.cell];
      sum.xx += part.share * on_upper.x() * path.x();
      sum.xy += part.share * (on_upper.x() * path.y() + on_upper.y() * path.x()) / 2;
      sum.yy += part.share * on_upper.y() * path.y();
    }
  }
  return cells;
}

}  // namespace clca::measure
