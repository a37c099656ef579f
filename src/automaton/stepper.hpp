#pragma once
// Provisional directions, conflicts, moves and waking of one step.

#include <span>
#include <vector>

#include "automaton/active_rule.hpp"
#include "automaton/claims.hpp"
#include "automaton/lane.hpp"
#include "automaton/passive_rule.hpp"
#include "automaton/strips.hpp"
#include "automaton/update_order.hpp"
#include "automaton/world.hpp"
#include "clca/automaton/automaton.hpp"
#include "clca/parallel/first_failure.hpp"

namespace clca::automaton {

/// Moves the particles of a world by themselves.
class Stepper {
 public:
  Stepper(World& world, const Options& options);

  /// Looks at the awake particles and carries out one step of moves. Everybody who may have gained
  /// a free direction is awake afterwards. Returns how many moved.
  std::size_t advance();

  /// How many the last step has looked at.
  std::size_t looked_at() const { return looked_at_; }

  /// True when nothing could be decided otherwise in the next step: no particle that overlaps had
  /// moved in the step before the last.
  bool was_quiet() const { return quiet_; }

  /// Calls `visit` with the id of each particle that moved in the last step.
  template <class Visit>
  void for_each_moved(Visit visit) const {
    for (const Lane& lane : busy()) {
      for (const Movers& movers : lane.movers) {
        for (const Bag<Mover>* list : {&movers.falling, &movers.sloping}) {
          for (const Mover& mover : *list) {
            if (mover.move != grains::kRest) {
              visit(mover.id);
            }
          }
        }
      }
    }
    for (const Mover& mover : pushed_) {
      visit(mover.id);
    }
  }

 private:
  bool parallel() const {
    return lanes_.size() > 1 && looked_at_ >= options_.parallel_from && world_.state.pushes.empty();
  }
  /// The lanes that take part in this step.
  std::span<Lane> busy() { return std::span(lanes_).first(in_parallel_ ? lanes_.size() : 1); }
  std::span<const Lane> busy() const {
    return std::span(lanes_).first(in_parallel_ ? lanes_.size() : 1);
  }
  /// Calls `visit` with the movers of a strip, whoever has found them.
  template <class Visit>
  void for_each_mover(const Lane& lane, Bag<Mover> Movers::*list, Visit visit) {
    for (Lane& finder : busy()) {
      for (Mover& mover : finder.movers[lane.strip].*list) {
        visit(mover);
      }
    }
  }
  void wake_all();
  void take_woken();
  /// Forgets the last step but for its movers, whose records hold where nothing else has moved a
  /// particle.
  void begin_step();
  /// After the looks.
  static void forget_awake(Lane& lane) {
    lane.awake.clear();
    lane.dealt = 0;
  }
  void step_alone();
  void step_together();
  template <class Work>
  void for_each_lane(parallel::FirstFailure& failure, Work work);
  void balance();

  // Phases of a step, each for one thread. Looks, see lane_looks.cpp:
  void look(Lane& lane);
  void look_at(Lane& lane, Lane& whose);
  void look_at_listed(Lane& lane, const Lane& whose, std::span<const std::uint32_t> ids);
  lattice::Site site_of(const grains::Particle& particle) const {
    return {world_.state.lattice.wrapped(particle.column), particle.row};
  }
  /// One that moved, or lost, in the last step.
  Candidate candidate(const Mover& before) const;
  bool dealt_elsewhere(const Lane& whose, std::uint32_t id, lattice::Site at) const;
  Access access(lattice::Site site, std::size_t strip) const;
  void decide(Lane& lane, const Candidate& candidate);
  grains::Move provisional_by_parts(Candidate candidate, Access access) const;
  /// As things stand now, for one that has not moved yet.
  bool lead_is_free(const Mover& mover, lattice::Direction to) const;

  // Moves, see lane_moves.cpp:
  void mark_found_by_others(Lane& lane);
  void move(Lane& lane);
  void move_unless_contested(Lane& lane, Mover& mover);
  void carry(Lane& lane, const Mover& mover);
  void carry_or_rest(Lane& lane, const Mover& mover);
  /// Of those carried since the last time.
  void wake_neighbours(Lane& lane);
  void end_turns(Lane& lane);

  // Contests, see lane_contests.cpp:
  void claim(Lane& lane);
  void contest(Mover& mover);
  void contest_falling(Lane& lane);
  void forget_claim(const Mover& mover);
  std::uint16_t contested_lead(const Mover& mover) const;
  void give_turn(Mover& mover);
  bool is_open(const Mover& mover, bool any_open) const;
  void leave_open(const Mover& mover);
  void give_own_turns(Lane& lane);
  void give_open_turns();  // for all threads
  void end_contests(Lane& lane);
  /// The same where some may overlap, on one thread.
  void give_turns_in_place(Lane& lane);
  UpdateKey key(const Mover& mover) const {
    return order_.key(mover.id, mover.previous, mover.move, world_.state.step);
  }

  // Particles that overlap, see engaged_step.cpp.
  void move_engaged(Lane& lane);
  Mover engaged_mover(std::uint32_t id) const;
  void decide_engaged();
  void move_pushed();
  void yield_to_pushed(Bag<Mover>& movers);

  World& world_;
  Options options_;
  ActiveRule rule_;
  UpdateOrder order_;
  PassiveRule passive_;
  Claims claims_;
  Strips strips_;
  int tallest_;  ///< sites from the reference site of a particle to any other, at the most
  std::vector<Lane> lanes_;
  std::vector<Turn> open_;
  std::vector<Mover> pushed_;  // by the passive rule
  std::vector<Mover> freed_;   // overlap, but go by themselves
  std::size_t looked_at_;
  bool in_parallel_ = false;     // this step
  bool notes_load_ = false;      // in this step
  std::size_t busy_before_ = 1;  // lanes that took part in the step before the last
  bool records_hold_ = false;    // see begin_step()
  bool quiet_ = true;
  bool still_ = false;  // nothing moved in the last step, and nothing that overlaps in that before
};

}  // namespace clca::automaton
