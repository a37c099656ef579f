#pragma once
// Convection in a shaken bed: mean displacement of particles per cycle.

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "clca/measure/displacement.hpp"
#include "clca/measure/grid.hpp"
#include "clca/reflection/reflection.hpp"

namespace clca::measure {

/// Mean displacement of the particles that start a cycle in a grid cell.
struct ConvectionArrow {
  Eigen::Vector2d centre;        ///< of the cell, lattice spacings
  Eigen::Vector2d displacement;  ///< mean per cycle, lattice spacings
  double weight = 0;             ///< particle sites that the mean is over, of all cycles
};

/// Rotation of two convection rolls side by side, in the width of the bed at the start of a cycle.
struct ConvectionRolls {
  /// Mean vertical displacement per cycle in the middle third of the width minus that in the two
  /// outer sixths, lattice spacings.
  /// Positive if the bed rises inside and sinks at the walls; uniform motion cancels.
  double centre_minus_wall = 0;
  /// Mean rotation of each half of the bed about its centre of mass, radians per cycle,
  /// anticlockwise positive: the best-fitting rigid rotation, half the curl of the drift.
  /// Up inside and down at the walls: left positive, right negative.
  double rotation_left = 0;
  double rotation_right = 0;
};

/// The state at the start of a cycle. Not nested in Convection: clang 14 takes a nested struct with
/// such initializers as not default-constructible in an optional member.
struct CycleStart {
  Snapshot snapshot = {};
  double left = 0;  ///< edges of the bed, lattice spacings
  double right = 0;

  CLCA_FIELDS(snapshot, left, right);
};

/// Accumulates displacements over cycles. Means are weighted by the sites of the particles.
class Convection {
 public:
  /// `cell`: side of the cells of the grid, in lattice spacings.
  Convection(const lattice::Lattice& lattice, double cell);

  void begin_cycle(const grains::State& state);
  /// Ignores particles that entered or left during it. Throws std::logic_error before any cycle.
  void end_cycle(const grains::State& state);

  std::uint64_t completed_cycles() const { return cycles_; }
  /// For the cells in which some particle started a cycle, in the order of Grid.
  std::vector<ConvectionArrow> arrows() const;
  /// None before the end of the first cycle, or if no particle is inside or at the walls.
  std::optional<ConvectionRolls> rolls() const;

  /// False if this cannot have been accumulated by a run that reached `now`.
  bool precedes(const grains::State& now) const;
  CLCA_FIELDS(begin_, cycles_, cells_, inside_, at_walls_, halves_);

 private:
  struct Mean {
    double weight = 0;
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();

    CLCA_FIELDS(weight, sum);
  };
  /// Sums over one half of the bed; positions relative to its middle at the floor of the box.
  struct HalfBedSums {
    double weight = 0;                                // sites, by which the sums are weighted
    Eigen::Vector2d place = Eigen::Vector2d::Zero();  // positions at the start of the cycle
    Eigen::Vector2d drift = Eigen::Vector2d::Zero();  // displacements in the cycle
    double cross = 0;                                 // vector products of both
    double square = 0;                                // squared positions

    void add(const Eigen::Vector2d& at, const Displacement& displacement, double sites);
    double rotation() const;
    CLCA_FIELDS(weight, place, drift, cross, square);
  };
  void add(const Displacement& displacement, double left, double right);

  Grid grid_;
  std::optional<CycleStart> begin_;
  std::uint64_t cycles_ = 0;
  std::vector<Mean> cells_;
  Mean inside_;                        // of particles in the middle third of the width
  Mean at_walls_;                      // of those in the outer sixths
  std::array<HalfBedSums, 2> halves_;  // left, right
};

}  // namespace clca::measure
