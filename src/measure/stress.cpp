#include "clca/measure/stress.hpp"

#include <cmath>

namespace clca::measure {

std::vector<StressCell> stress_field(const grains::State& state,
                                     std::span<const contact::Force> forces, double cell) {
  constexpr int kParts = 32;  // of a branch, each in one cell
  const Grid grid(state.lattice, cell);
  std::vector<StressCell> cells(grid.size());
  for (std::size_t i = 0; i < cells.size(); ++i) {
    cells[i].centre = grid.centre(i);
  }
  for (const contact::Force& force : forces) {
    const Eigen::Vector2d& branch = force.branch;
    const Eigen::Vector2d on_upper = force.on_upper() / (kParts * grid.cell_area());
    const auto with_grain = grains::is_particle(force.other);
    const Eigen::Vector2d end =
        with_grain ? grains::centre(state, state.particles[force.upper]) : force.point + branch;
    for (int part = 0; part < kParts; ++part) {
      StressCell& one = cells[grid.index(end - (part + 0.5) / kParts * branch)];
      one.xx += on_upper.x() * branch.x();
      one.xy += (on_upper.x() * branch.y() + on_upper.y() * branch.x()) / 2;
      one.yy += on_upper.y() * branch.y();
    }
  }
  return cells;
}

}  // namespace clca::measure
