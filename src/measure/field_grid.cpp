#include "clca/measure/field_grid.hpp"

#include "measure/particle_sites.hpp"

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
      const std::size_t cell = grid.index(lattice::position(site));
      filled[cell] += taken[lattice.index(site)] ? 1 : 0;
      all[cell] += 1;
    }
  }
  for (std::size_t cell = 0; cell < filled.size(); ++cell) {
    filled[cell] /= all[cell] > 0 ? all[cell] : 1;
  }
  return filled;
}

/// Two passes: the difference of two means would not be exactly 0 where all particles move alike.
void add_velocities(std::vector<FieldCell>& cells, const Grid& grid,
                    const std::vector<Displacement>& displacements, double steps) {
  std::vector<double> sites(cells.size(), 0.0);
  for (const Displacement& displacement : displacements) {
    const std::size_t cell = grid.index(displacement.from);
    sites[cell] += displacement.sites;
    ++cells[cell].particles;
    cells[cell].velocity += displacement.sites * displacement.vector / steps;
  }
  for (std::size_t cell = 0; cell < cells.size(); ++cell) {
    cells[cell].velocity /= sites[cell] > 0 ? sites[cell] : 1;
  }
  for (const Displacement& displacement : displacements) {
    const std::size_t cell = grid.index(displacement.from);
    const Eigen::Vector2d deviation = displacement.vector / steps - cells[cell].velocity;
    cells[cell].fluctuation += 0.5 * deviation.squaredNorm() * displacement.sites / sites[cell];
  }
}

}  // namespace

Fields FieldWindow::fields(const State& now, double cell) const {
  const Grid grid(now.lattice, cell);
  Fields fields{.columns = grid.columns(), .rows = grid.rows()};
  fields.cells.resize(grid.size());
  const std::vector<double> packing = packing_of(now, grid);
  for (std::size_t place = 0; place < grid.size(); ++place) {
    fields.cells[place].centre = grid.centre(place);
    fields.cells[place].packing = packing[place];
  }
  const std::uint64_t steps = now.step - begin_.step();
  add_velocities(fields.cells, grid, begin_.displacements(now),
                 steps > 0 ? static_cast<double>(steps) : 1);
  return fields;
}

double fluctuation_energy(const Fields& fields) {
  double sum = 0;
  double particles = 0;
  for (const FieldCell& cell : fields.cells) {
    sum += cell.fluctuation * static_cast<double>(cell.particles);
    particles += static_cast<double>(cell.particles);
  }
  return particles > 0 ? sum / particles : 0;
}

}  // namespace clca::measure
