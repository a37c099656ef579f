#pragma once
// Coarse-grained fields: packing, velocity and its fluctuations on the cells of a grid.

#include <vector>

#include "clca/fields/fields.hpp"
#include "clca/measure/grid.hpp"
#include "clca/measure/snapshot.hpp"

namespace clca::measure {

/// Means are over particles that began the window in the cell, weighted by their sites.
struct FieldCell {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();  ///< lattice spacings
  double packing = 0;                                ///< share of the sites taken by particles now
  std::size_t particles = 0;                         ///< that the means are over
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();  ///< mean, spacings per step
  /// 1/2 <|v - <v>|^2>: kinetic energy of the fluctuations per unit mass, (spacings per step)^2.
  double fluctuation = 0;
};

struct Fields {
  std::size_t columns = 0;
  std::size_t rows = 0;
  std::vector<FieldCell> cells = {};  ///< in the order of Grid
};

/// A span of steps, over which velocities are displacement per step.
class FieldWindow {
 public:
  /// Begins the window.
  explicit FieldWindow(const grains::State& state) : begin_(state) {}

  /// Fields if the window ends now, on a Grid of side `cell` (lattice spacings). Particles that
  /// came or left within the window count in the packing only. In a window of no steps all
  /// velocities are 0.
  Fields fields(const grains::State& now, double cell) const;
  /// What the particles did if the window ends now, as Snapshot::journeys.
  std::vector<Journey> journeys(const grains::State& now) const { return begin_.journeys(now); }

  /// False where the window did not begin in a run that has come to `now`.
  bool precedes(const grains::State& now) const { return begin_.precedes(now); }
  static constexpr auto fields() {
    using fields::field;
    return std::make_tuple(field("begin", &FieldWindow::begin_));
  }

 private:
  Snapshot begin_;
};

/// Mean of the fluctuation over cells, weighted by their particles; 0 where there are none.
double fluctuation_energy(const Fields& fields);

}  // namespace clca::measure
