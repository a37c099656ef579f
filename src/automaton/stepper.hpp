#pragma once
// Provisional directions, conflicts, moves and waking of one step.

#include <vector>

#include "automaton/active_rule.hpp"
#include "automaton/awake_set.hpp"
#include "automaton/claims.hpp"
#include "automaton/update_order.hpp"
#include "clca/automaton/automaton.hpp"
#include "clca/automaton/footprint.hpp"
#include "clca/automaton/occupancy.hpp"

namespace clca::automaton {

/// A particle with a provisional direction.
struct Mover {
  std::size_t place = 0;    ///< in memory, of its reference site when the step began
  std::int32_t column = 0;  ///< of that site, wrapped
  std::uint32_t id = 0;
  Move move = kRest;
  bool contested = false;
  const Footprint* footprint = nullptr;
};

/// Moves the particles of a state and keeps its occupancy in line.
class Stepper {
 public:
  Stepper(const State& state, const Options& options);

  /// Looks at the awake particles and carries out one step of moves. Everybody who may have gained
  /// a free direction is awake afterwards. Returns how many moved.
  std::size_t advance(State& state, Occupancy& occupancy);

  /// Calls `visit` with the id of each particle that moved in the last step.
  template <class Visit>
  void for_each_moved(const State& state, Visit visit) const {
    for (const std::vector<Mover>* movers : {&falling_, &sloping_}) {
      for (const Mover& mover : *movers) {
        if (state.particles[mover.id].previous != kRest) {
          visit(mover.id);
        }
      }
    }
  }

  void wake(std::uint32_t id) { awake_.insert(id); }
  /// Wakes those who may gain a free direction when `particle` vanishes.
  void wake_around(const State& state, const Occupancy& occupancy, const Particle& particle);
  void grow(std::size_t particles) { awake_.resize(particles); }

 private:
  /// A contested mover and its place in the order.
  struct Turn {
    UpdateKey key;
    const Mover* mover = nullptr;
  };

  bool parallel() const {
    return options_.threads > 1 && looked_at_.size() >= options_.parallel_from;
  }

  // With kShared the work is cut over the threads.
  template <bool kShared, class Visit>
  void for_each(std::size_t count, Visit visit) const;
  template <bool kShared>
  void carry_out(State& state, Occupancy& occupancy);
  template <bool kShared>
  void decide(State& state, const Occupancy& occupancy);
  void collect_movers(const State& state);
  template <bool kShared>
  void find_contested(const lattice::Lattice& lattice);
  template <bool kShared>
  void move_uncontested(const std::vector<Mover>& movers, State& state, Occupancy& occupancy);
  std::size_t move_contested(State& state, Occupancy& occupancy);
  template <bool kShared>
  void carry(const Mover& mover, State& state, Occupancy& occupancy);

  Options options_;
  ActiveRule rule_;
  UpdateOrder order_;
  FootprintTable footprints_;
  AwakeSet awake_;
  Claims claims_;
  std::vector<std::uint32_t> looked_at_;
  std::vector<Move> wishes_;    // of those looked at, in the same order
  std::vector<Mover> falling_;  // along gravity
  std::vector<Mover> sloping_;  // all other directions
  std::vector<Turn> turns_;
};

}  // namespace clca::automaton
