#pragma once
// Convection of a bed that is shaken: the mean drift of particles per cycle.

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "clca/fields/fields.hpp"
#include "clca/measure/grid.hpp"
#include "clca/measure/snapshot.hpp"

namespace clca::measure {

/// Mean drift of the particles that begin a cycle in a cell of the grid.
struct Arrow {
  Eigen::Vector2d centre;        ///< of the cell, lattice spacings
  Eigen::Vector2d displacement;  ///< mean per cycle, lattice spacings
  double weight = 0;             ///< particle sites that the mean is over, of all cycles
};

/// How two rolls side by side turn. The width of the bed is that of its particles at the begin of
/// each cycle.
struct Rolls {
  /// Mean vertical displacement per cycle within the middle third of the width less that within the
  /// outer sixths at both sides, lattice spacings: positive where the bed goes up inside and down
  /// at the walls. What the whole bed rises or sinks drops out.
  double centre_minus_wall = 0;
  /// Mean rotation of the left and of the right half of the bed about its own centre of mass, in
  /// radians per cycle, anticlockwise positive: the rate of the rigid rotation nearest to the
  /// drift, half of its curl. Up inside and down at the walls: left positive, right negative.
  double circulation_left = 0;
  double circulation_right = 0;
};

/// Accumulates the drift over cycles. All means are weighted by the particles' sites.
class Convection {
 public:
  /// `cell`: side of the cells of the grid, in lattice spacings.
  Convection(const lattice::Lattice& lattice, double cell);

  void begin_cycle(const grains::State& state);
  /// Particles that came or left within the cycle are left out. Throws std::logic_error where no
  /// cycle has begun.
  void end_cycle(const grains::State& state);

  std::uint64_t cycles() const { return cycles_; }
  /// Of the cells in which a particle ever began a cycle, in the order of Grid.
  std::vector<Arrow> arrows() const;
  /// None before the first cycle has ended and where no particle is inside or at the walls.
  std::optional<Rolls> rolls() const;

  /// False where this did not accumulate in a run that has come to `now`.
  bool precedes(const grains::State& now) const;
  static constexpr auto fields();

 private:
  struct Mean {
    double weight = 0;
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();

    static constexpr auto fields() {
      using fields::field;
      return std::make_tuple(field("weight", &Mean::weight), field("sum", &Mean::sum));
    }
  };
  /// Sums over one half of the bed, places seen from its middle at the floor of the box.
  struct Moments {
    double weight = 0;
    Eigen::Vector2d place = Eigen::Vector2d::Zero();
    Eigen::Vector2d drift = Eigen::Vector2d::Zero();
    double cross = 0;   // of place and drift
    double square = 0;  // of place

    void add(const Eigen::Vector2d& at, const Journey& journey);
    double rotation() const;
    static constexpr auto fields() {
      using fields::field;
      return std::make_tuple(field("weight", &Moments::weight), field("place", &Moments::place),
                             field("drift", &Moments::drift), field("cross", &Moments::cross),
                             field("square", &Moments::square));
    }
  };
  /// What is kept from the begin of a cycle.
  struct Begin {
    Snapshot snapshot = {};
    double left = 0;  // edges of the bed, lattice spacings
    double right = 0;

    static constexpr auto fields() {
      using fields::field;
      return std::make_tuple(field("snapshot", &Begin::snapshot), field("left", &Begin::left),
                             field("right", &Begin::right));
    }
  };

  void add(const Journey& journey, double left, double right);

  Grid grid_;
  std::optional<Begin> begin_;
  std::uint64_t cycles_ = 0;
  std::vector<Mean> cells_;
  Mean inside_;
  Mean at_walls_;
  std::array<Moments, 2> halves_;  // left, right
};

constexpr auto Convection::fields() {
  using fields::field;
  return std::make_tuple(field("begin", &Convection::begin_), field("cycles", &Convection::cycles_),
                         field("cells", &Convection::cells_), field("inside", &Convection::inside_),
                         field("at_walls", &Convection::at_walls_),
                         field("halves", &Convection::halves_));
}

}  // namespace clca::measure
