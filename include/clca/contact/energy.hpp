#pragma once
// Energy of the grains and what changes it, in units of a site's mass, gravity and the lattice
// spacing.

#include <tuple>

#include "clca/contact/state.hpp"
#include "clca/reflection/reflection.hpp"

namespace clca::contact {

struct Energy {
  double kinetic = 0;
  /// For the present direction of gravity; 0 if all centres of mass are at the height of the lower
  /// left site.
  double potential = 0;

  double sum() const { return kinetic + potential; }
};

/// `gravity` in lattice spacings per step squared.
Energy energy(const State& state, double gravity);

/// Energy that the grains exchange with all else. What remains of a change is dissipated.
struct EnergyExchange {
  double sources = 0;  ///< energy of the grains that enter
  double outlets = 0;  ///< energy of the grains that leave
  double walls = 0;    ///< work of moving walls: their forces on grains times their displacements
  /// Work of a moving vessel: what gravity that turns adds to the potential energy, and the work
  /// of the forces by shaking and of the centrifugal forces.
  double vessel = 0;

  /// What the grains have gained.
  double gained() const { return sources - outlets + walls + vessel; }
  EnergyExchange& operator+=(const EnergyExchange& other) {
    sources += other.sources;
    outlets += other.outlets;
    walls += other.walls;
    vessel += other.vessel;
    return *this;
  }
  static constexpr auto fields() {
    using reflection::field;
    return std::make_tuple(
        field("sources", &EnergyExchange::sources), field("outlets", &EnergyExchange::outlets),
        field("walls", &EnergyExchange::walls), field("vessel", &EnergyExchange::vessel));
  }
};

}  // namespace clca::contact
