#pragma once
// The site lists of every kind of particle, ready for use on one lattice.

#include <array>
#include <span>
#include <vector>

#include "clca/automaton/state.hpp"

namespace clca::automaton {

/// The sites of one kind seen from reference columns of one parity.
struct Footprint {
  std::vector<lattice::Offset> body;
  std::array<std::vector<lattice::Offset>, lattice::kDirectionCount> lead;
  std::array<std::vector<lattice::Offset>, lattice::kDirectionCount> trail;
  /// Sites whose owners may gain a free direction when the particle has moved that way (seen from
  /// where it stood before).
  std::array<std::vector<lattice::Offset>, lattice::kDirectionCount> wake;
};

/// Directions that the rules allow: gravity first, then its neighbours clockwise and
/// anticlockwise, then the rest.
std::span<const lattice::Direction> candidate_directions(const Rules& rules);

class FootprintTable {
 public:
  explicit FootprintTable(const State& state);

  const Footprint& of(const Particle& particle) const {
    return table_[2 * particle.kind + (lattice::is_odd(particle.column) ? 1U : 0U)];
  }

 private:
  std::vector<Footprint> table_;
};

}  // namespace clca::automaton
