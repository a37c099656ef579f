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

}  // namespace clca::measure
