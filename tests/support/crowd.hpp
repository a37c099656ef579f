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
  explicit Crowd(automaton::State& state) : state_(state), owners_(occupants(state)) {}

  const automaton::State& state() const { return state_; }
  const automaton::Particle& particle(automaton::Owner id) const {
    return state_.particles[static_cast<std::size_t>(id)];
  }
  std::set<automaton::Owner> owners(lattice::Site site) const;
  std::vector<automaton::Push> pushes_onto(automaton::Owner id) const;

  /// Sites that the particle would enter.
  Sites lead(automaton::Owner id, lattice::Direction direction) const;
  /// With everybody with whom it shares sites before or after the move.
  std::map<automaton::Owner, Change> changes(automaton::Owner id,
                                             lattice::Direction direction) const;
  /// Whether it may go that way by itself.
  bool is_free(automaton::Owner id, lattice::Direction direction) const;
  /// Sites that it shares with particles, and how many it may share.
  int burden(automaton::Owner id) const;
  int limit(automaton::Owner id) const;

  /// Moves the particle; pushes that have ended go.
  void move(automaton::Owner id, lattice::Direction direction);
  void record(const automaton::Push& push);

 private:
  std::set<automaton::Owner> others(automaton::Owner id, const Sites& sites) const;

  automaton::State& state_;
  std::map<lattice::Site, std::set<automaton::Owner>> owners_;
};

}  // namespace clca::testing
