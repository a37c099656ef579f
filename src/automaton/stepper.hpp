#pragma once
// Provisional directions, conflicts, moves and waking of one step.

#include <vector>

#include "automaton/active_rule.hpp"
#include "automaton/claims.hpp"
#include "automaton/passive_rule.hpp"
#include "automaton/update_order.hpp"
#include "automaton/world.hpp"
#include "clca/automaton/automaton.hpp"

namespace clca::automaton {

/// A particle with a provisional direction.
struct Mover {
  std::size_t place = 0;    ///< in memory, of its reference site when the step began
  std::int32_t column = 0;  ///< of that site, wrapped
  std::uint32_t id = 0;
  Move move = kRest;
  bool contested = false;
  bool engaged = false;  ///< overlaps with somebody: has its turn among the contested
  const Footprint* footprint = nullptr;
};

/// Moves the particles of a world by themselves.
class Stepper {
 public:
  Stepper(World& world, const Options& options);

  /// Looks at the awake particles and carries out one step of moves. Everybody who may have gained
  /// a free direction is awake afterwards. Returns how many moved.
  std::size_t advance();

  /// True when nothing could be decided otherwise in the next step: no particle that overlaps had
  /// moved in the step before the last.
  bool was_quiet() const { return quiet_; }

  /// Calls `visit` with the id of each particle that moved in the last step.
  template <class Visit>
  void for_each_moved(Visit visit) const {
    for (const std::vector<Mover>* movers : {&falling_, &sloping_}) {
      for (const Mover& mover : *movers) {
        if (world_.state.particles[mover.id].previous != kRest) {
          visit(mover.id);
        }
      }
    }
    for (const Mover& mover : pushed_) {
      visit(mover.id);
    }
  }

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
  void carry_out();
  template <bool kShared>
  void decide();
  void collect_movers();
  template <bool kShared>
  void find_contested();
  template <bool kShared>
  void move_uncontested(const std::vector<Mover>& movers);
  std::size_t move_contested();
  template <bool kShared>
  void carry(const Mover& mover);

  Mover mover(std::uint32_t id, Move move) const;
  UpdateKey key(std::uint32_t id, Move move) const {
    return order_.key(id, world_.state.particles[id].previous, move, world_.state.step);
  }
  void rest(std::uint32_t id);

  // Particles that overlap, see engaged_step.cpp.
  void leave_out_engaged();
  void move_engaged();
  void decide_engaged();
  void move_pushed();
  void yield_to_pushed(std::vector<Mover>& movers);

  World& world_;
  Options options_;
  ActiveRule rule_;
  UpdateOrder order_;
  PassiveRule passive_;
  Claims claims_;
  std::vector<std::uint32_t> looked_at_;
  std::vector<Move> wishes_;    // of those looked at, in the same order
  std::vector<Mover> falling_;  // along gravity
  std::vector<Mover> sloping_;  // all other directions
  std::vector<Turn> turns_;
  std::vector<Mover> pushed_;  // by the passive rule
  std::vector<Mover> freed_;   // overlap, but go by themselves
  bool quiet_ = true;
  bool still_ = false;  // nothing moved in the last step, and nothing that overlaps in that before
};

}  // namespace clca::automaton
