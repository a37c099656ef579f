#pragma once
// A state in the middle of a step and who stands where, as plainly as it can be.

#include <map>
#include <set>
#include <vector>

#include "support/overlaps.hpp"

namespace clca::testing {

/// What a move would change in the overlap of two.
struct Change {
  int sites_before = 0;
  int sites_after = 0;
  int depth_before = 0;
  int depth_after = 0;
};

class Crowd {
 public:
  explicit Crowd(grains::State& state) : state_(state), owners_(occupants(state)) {}

  const grains::State& state() const { return state_; }
  const grains::Particle& particle(grains::Owner id) const {
    return state_.particles[static_cast<std::size_t>(id)];
  }
  std::set<grains::Owner> owners(lattice::Site site) const;
  std::vector<grains::Push> pushes_onto(grains::Owner id) const;

  /// Sites that the particle would enter.
  Sites lead(grains::Owner id, lattice::Direction direction) const;
  /// With everybody with whom it shares sites before or after the move.
  std::map<grains::Owner, Change> changes(grains::Owner id, lattice::Direction direction) const;
  /// Whether it may go that way by itself.
  bool is_free(grains::Owner id, lattice::Direction direction) const;
  /// Sites that it shares with particles, and how many it may share.
  int burden(grains::Owner id) const;
  int limit(grains::Owner id) const;

  /// Moves the particle; pushes that have ended go.
  void move(grains::Owner id, lattice::Direction direction);
  void record(const grains::Push& push);

 private:
  std::set<grains::Owner> others(grains::Owner id, const Sites& sites) const;

  grains::State& state_;
  std::map<lattice::Site, std::set<grains::Owner>> owners_;
};

}  // namespace clca::testing
