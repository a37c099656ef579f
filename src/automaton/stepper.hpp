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
            if (world_.state.particles[mover.id].previous != kRest) {
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
  /// Forgets who was awake, for those to come who are in the next step.
  static void begin_waking(Lane& lane);
  void step_alone();
  void step_together();
  template <class Work>
  void for_each_lane(Work work);
  void balance();

  // Phases of a step, each for one thread, see lane_looks.cpp and lane_moves.cpp.
  void look(Lane& lane);
  void look_at(Lane& lane, Lane& whose);
  bool dealt_elsewhere(const Lane& whose, std::uint32_t id, lattice::Site at) const;
  void decide(Lane& lane, const Lane& whose, std::uint32_t id);
  Move provisional_by_parts(const Mover& mover, Move previous) const;
  /// As things stand now, for one that has not moved yet.
  bool lead_is_free(const Mover& mover, lattice::Direction to) const;
  void claim(Lane& lane);
  void contest_falling(Lane& lane);
  void contest_sloping(Lane& lane);
  void move_uncontested(Lane& lane);
  void carry(Lane& lane, const Mover& mover);
  std::uint16_t contested_lead(const Mover& mover) const;
  void choose_winners();  // for all threads
  void move_winners(Lane& lane);
  void end_contests(const Lane& lane);
  /// Decides nothing yet.
  [[gnu::always_inline]] Mover mover(std::uint32_t id, const Particle& particle) const {
    const lattice::Site site = {world_.state.lattice.wrapped(particle.column), particle.row};
    const std::size_t strip = in_parallel_ ? strips_.of(site) : 0;
    Mover mover = {.site = site,
                   .footprint = &world_.footprints.of(particle),
                   .id = id,
                   .strip = static_cast<std::uint16_t>(strip),
                   .access = strips_.at_seam(site)                ? Access::seam
                             : lanes_[strip].inner.contains(site) ? Access::alone
                                                                  : Access::shared};
    if (mover.footprint->one_window && mover.access != Access::seam) {
      const lattice::Site corner = mover.footprint->corner;
      mover.at = world_.occupancy.corner({site.column + corner.column, site.row + corner.row});
      mover.taken = world_.occupancy.window(mover.at);
    }
    return mover;
  }

  void merge_turns();
  void give_turns();
  UpdateKey key(std::uint32_t id, Move move) const {
    return order_.key(id, world_.state.particles[id].previous, move, world_.state.step);
  }
  void rest(Lane& lane, std::uint32_t id);

  // Particles that overlap, see engaged_step.cpp.
  void move_engaged(Lane& lane);
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
  std::vector<Turn> turns_;
  std::vector<Mover> pushed_;  // by the passive rule
  std::vector<Mover> freed_;   // overlap, but go by themselves
  std::size_t looked_at_;
  std::size_t contested_moved_ = 0;
  bool in_parallel_ = false;  // this step
  bool quiet_ = true;
  bool still_ = false;  // nothing moved in the last step, and nothing that overlaps in that before
};

}  // namespace clca::automaton
