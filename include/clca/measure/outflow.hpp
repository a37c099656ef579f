#pragma once
// Discharge through outlets over time.

#include <cstdint>
#include <vector>

#include "clca/grains/occupancy.hpp"
#include "clca/grains/state.hpp"
#include "clca/lattice/direction.hpp"
#include "clca/reflection/reflection.hpp"

namespace clca::measure {

/// Particles and sites removed by all outlets.
struct Discharge {
  std::uint64_t particles = 0;
  std::uint64_t sites = 0;

  CLCA_FIELDS(particles, sites);
};

Discharge discharge(const grains::State& state);
Discharge discharge(const grains::Outlet& outlet);

/// Numbers of particles that have left, by outlet and, within it, by species. `species`: how many
/// there are. Throws std::invalid_argument if a particle that has left lies in no outlet.
std::vector<std::uint64_t> discharged_counts(const grains::State& state, std::size_t species);

/// Records a discharge in a stage, step by step.
class Outflow {
 public:
  Outflow() = default;
  /// `begin`: the totals before the stage.
  explicit Outflow(Discharge begin) : begin_(begin), last_(begin) {}

  /// Call before the first step with the totals, if something has left since. Throws like add().
  void add_at_start(Discharge total);
  /// Call after each step with the totals. Throws std::invalid_argument if they decrease.
  void add(Discharge total);

  Discharge stage_discharge() const {
    return {last_.particles - begin_.particles, last_.sites - begin_.sites};
  }
  /// Mean rate between 20 % and 70 % of the final discharge; 0 with fewer than two particles.
  double sites_per_step() const;
  /// False if this cannot have been recorded in a run that reached the total `now`.
  bool precedes(Discharge now) const;

  CLCA_FIELDS(begin_, last_, steps_, events_);

 private:
  /// Total of sites discharged after a step.
  struct Event {
    std::uint64_t step = 0;
    std::uint64_t sites = 0;

    CLCA_FIELDS(step, sites);
  };

  Discharge begin_;
  Discharge last_;
  std::uint64_t steps_ = 0;
  std::vector<Event> events_;  // the steps in which something left
};

/// Whether particles are held up above an outlet that they could have passed; at rest this means
/// that it is clogged. A particle has a way through the outlet if it could fall into it past the
/// walls, straight `down` or along the two slopes beside it, and not straight into another outlet.
/// Take the largest kind with such a particle, and all sites from which another one could fall
/// into the outlet now. At one of them, below the top of the box, there is no way further up, with
/// particles in one of the three; or none of them is at the top of the box, and without particles
/// one would be. A heap beside an open orifice is not held up. Throws std::invalid_argument if the
/// occupancy belongs to another box, std::out_of_range if there is no such outlet.
bool is_clogged(const grains::State& state, const grains::Occupancy& occupancy, std::size_t outlet,
                lattice::Direction down);

}  // namespace clca::measure
