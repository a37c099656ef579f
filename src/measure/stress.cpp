#include "clca/measure/stress.hpp"

#include <algorithm>

#include "clca/lattice/region.hpp"
#include "measure/internal/sites.hpp"
#include "measure/numbers.hpp"

namespace clca::measure {

namespace {

class Walls {
 public:
  explicit Walls(const grains::State& state)
      : state_(state), sites_(state.lattice.index_count(), false) {
    for (const lattice::Site site : wall_sites(state)) {
      sites_[state.lattice.index(site)] = true;
    }
  }

  /// The path of a force on a wall to the centre of the grain, against the normal: through the wall
  /// to its far side, or to that of the box behind it. The branch if it misses the wall.
  Eigen::Vector2d path(const contact::Force& force) const {
    constexpr double kStep = 1.0 / 16;  // lattice spacings
    const Eigen::Vector2d centre = force.point + force.branch;
    const auto at = [&](double length) { return Eigen::Vector2d(centre - length * force.normal); };
    const double reached = reach(state_.shape(state_.particles[force.upper])) + 1;
    double length = 0;
    while (length < reached && !is_wall(at(length))) {
      length += kStep;
    }
    if (length >= reached) {
      return force.branch;
    }
    const double most = to_side(centre, force.normal);
    while (length < most && (is_wall(at(length)) || !is_inside(at(length)))) {
      length += kStep;
    }
    return std::min(length, most) * force.normal;
  }

 private:
  /// Whether the site of a point is such; or of two sites left and right of it, one.
  template <class Is>
  static bool at_site(const Eigen::Vector2d& point, const Is& is) {
    const Eigen::Vector2d aside(kRounding, 0);
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

  /// How far the side of the box lies from a point against the normal.
  double to_side(const Eigen::Vector2d& point, const Eigen::Vector2d& normal) const {
    const Eigen::Vector2d low = lattice::Lattice::corner();
    const Eigen::Vector2d high = low + state_.lattice.size();
    double least = state_.lattice.size().norm();
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

std::vector<StressCell> stress_field(const grains::State& state,
                                     std::span<const contact::Force> forces, double cell) {
  const Grid grid(state.lattice, cell);
  const Walls walls(state);
  std::vector<StressCell> cells(grid.size());
  for (std::size_t i = 0; i < cells.size(); ++i) {
    cells[i].centre = grid.centre(i);
  }
  for (const contact::Force& force : forces) {
    const bool with_grain = grains::is_particle(force.other);
    const Eigen::Vector2d centre = with_grain
                                       ? grains::centre_in_box(state, state.particles[force.upper])
                                       : Eigen::Vector2d(force.point + force.branch);
    const Eigen::Vector2d path =
        with_grain || contact::is_side(force.other) ? force.branch : walls.path(force);
    const Eigen::Vector2d on_upper = force.on_upper() / grid.cell_area();
    for (const Grid::Part& part : grid.parts(centre - path, path)) {
      StressCell& sum = cells[part.cell];
      sum.xx += part.share * on_upper.x() * path.x();
      sum.xy += part.share * (on_upper.x() * path.y() + on_upper.y() * path.x()) / 2;
      sum.yy += part.share * on_upper.y() * path.y();
    }
  }
  return cells;
}

}  // namespace clca::measure
