#pragma once
// Provisional directions, conflicts, moves and waking of one step.

#include <span>
#include <vector>

#include "active_rule.hpp"
#include "awake_set.hpp"
#include "claims.hpp"
#include "clca/automaton/automaton.hpp"
#include "clca/automaton/footprint.hpp"
#include "clca/automaton/occupancy.hpp"
#include "update_order.hpp"

namespace clca::automaton {

/// A particle with a provisional direction.
struct Mover {
  std::size_t place = 0;  ///< in memory, of its reference site when the step began
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

  /// Looks at the awake particles and carries out one step of moves. Those that moved are in
  /// moved(), and everybody who may have gained a free direction is awake afterwards.
  void advance(State& state, Occupancy& occupancy);
  std::span<const Mover> moved() const { return moved_; }

  void wake(std::uint32_t id) { awake_.insert(id); }
  /// Wakes those who may gain a free direction when `particle` vanishes.
  void wake_around(const State& state, const Occupancy& occupancy, const Particle& particle);
  void grow(std::size_t particles) { awake_.resize(particles); }
  bool anyone_awake() const { return !awake_.empty(); }

 private:
  void decide(State& state, const Occupancy& occupancy);
  void collect_movers(const State& state);
  template <bool kShared>
  void claim(const lattice::Lattice& lattice);
  template <bool kShared>
  void move_uncontested(State& state, Occupancy& occupancy);
  void move_contested(State& state, Occupancy& occupancy);
  template <bool kShared>
  void wake_behind(const lattice::Lattice& lattice, const Occupancy& occupancy);
  template <bool kShared>
  void carry_out(State& state, Occupancy& occupancy);

  bool parallel() const {
    return options_.threads > 1 && looked_at_.size() >= options_.parallel_from;
  }

  Options options_;
  ActiveRule rule_;
  UpdateOrder order_;
  FootprintTable footprints_;
  AwakeSet awake_;
  Claims claims_;
  std::vector<std::uint32_t> looked_at_;
  std::vector<Move> wishes_;  // of those looked at, in the same order
  std::vector<Mover> movers_;
  std::vector<Mover> moved_;
  struct Turn {
    UpdateKey key;
    Mover mover;
  };
  std::vector<Turn> turns_;
};

}  // namespace clca::automaton
