#pragma once
// Coarse-grained fields: packing, velocity and its fluctuations on the cells of a grid.

#include <vector>

#include "clca/measure/grid.hpp"
#include "clca/measure/probe.hpp"
#include "clca/measure/snapshot.hpp"
#include "clca/reflection/reflection.hpp"

namespace clca::measure {

/// Means over the particles that started the window in the cell.
struct FieldCell : RegionMotion {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();  ///< lattice spacings
  double packing = 0;                                ///< share of its sites taken by particles now
};

struct Fields {
  std::size_t columns = 0;
  std::size_t rows = 0;
  std::vector<FieldCell> cells = {};  ///< in the order of Grid

  /// Memory of so many cells, with that for measuring them and their fluctuations.
  static double bytes_for(double cells) {
    return cells * (sizeof(FieldCell) + 2 * sizeof(RegionMotion) + 2 * sizeof(double));
  }
};

/// A window of steps: velocity is displacement per step.
class FieldWindow {
 public:
  /// Starts the window.
  explicit FieldWindow(const grains::State& state) : begin_(state) {}

  /// The fields if the window ends now, on a Grid of side `cell` (lattice spacings).
  /// Particles that entered or left during the window count for the packing only. In a window of
  /// zero steps all velocities are 0.
  Fields fields(const grains::State& now, double cell) const;
  /// Displacements of the particles if the window ends now.
  std::vector<Displacement> displacements(const grains::State& now) const {
    return begin_.displacements(now);
  }

  /// False if the window cannot have started in a run that reached `now`.
  bool precedes(const grains::State& now) const { return begin_.precedes(now); }
  CLCA_FIELDS(begin_);

 private:
  Snapshot begin_;
};

/// Mean fluctuation over cells, weighted by their particles; 0 if there are none.
double fluctuation_energy(const Fields& fields);

}  // namespace clca::measure
