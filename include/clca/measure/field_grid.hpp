#pragma once
// Coarse-grained fields: packing, velocity and its fluctuations on the cells of a grid, and in
// probes: rectangles of the box, in lattice spacings.

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "clca/grains/state.hpp"
#include "clca/lattice/region.hpp"
#include "clca/measure/grid.hpp"
#include "clca/measure/snapshot.hpp"
#include "clca/reflection/reflection.hpp"

namespace clca::measure {

/// Means over the particles that start in a region, weighted by their sites.
struct RegionMotion {
  double particles = 0;  ///< at least one; half of each on an edge between two regions
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();
  double fluctuation = 0;  ///< 1/2 <|v - <v>|^2>, the granular temperature
};

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

/// Of each region, share of its sites without walls that particles cover; 0 if walls cover all.
std::vector<double> fillings(const grains::State& state,
                             std::span<const lattice::Rectangle> regions);

/// Of displacements in `steps` steps; lattice spacings per step. None if no particle starts there.
std::optional<RegionMotion> motion_in(const lattice::Rectangle& region,
                                      const std::vector<Displacement>& displacements, double steps);

/// Sites of the particles whose centre of mass has passed the horizontal middle line of the region
/// downwards, less those that have passed it upwards. Each is taken to have gone straight from its
/// position at the snapshot, or where it has entered since (State::origins), to where it is or has
/// been removed.
double downward_flow(const Snapshot& before, const grains::State& now,
                     const lattice::Rectangle& region);

}  // namespace clca::measure
