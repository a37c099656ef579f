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
    for (const Lane& lane : lanes_) {
      for (const std::vector<Mover>* movers : {&lane.falling, &lane.sloping}) {
        for (const Mover& mover : *movers) {
          if (world_.state.particles[mover.id].previous != kRest) {
            visit(mover.id);
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
  void wake_all();
  void step_alone();
  void step_together();
  template <class Work>
  void for_each_lane(Work work);
  void balance();

  // Phases of a step, each for one thread, see lane_moves.cpp.
  void find_awake(Lane& lane);
  void take_over(Lane& lane);
  void look(Lane& lane, std::span<const std::uint32_t> ids);
  void decide(Lane& lane, std::uint32_t id);
  void note(Lane& lane, int column, std::uint32_t load) const;
  void claim(Lane& lane);
  void contest_falling(Lane& lane);
  void contest_sloping(Lane& lane);
  void move_uncontested(Lane& lane, const std::vector<Mover>& movers);
  void clear_claims(const Lane& lane);
  void carry(Lane& lane, const Mover& mover);
  /// Decides nothing yet.
  Mover mover(std::uint32_t id, const Particle& particle, Columns inner) const {
    const int column = world_.state.lattice.wrapped(particle.column);
    Mover mover = {.site = {column, particle.row},
                   .footprint = &world_.footprints.of(particle),
                   .id = id,
                   .access = inner.contains(column)    ? Access::alone
                             : strips_.at_seam(column) ? Access::seam
                                                       : Access::shared};
    if (mover.footprint->one_window && mover.access != Access::seam) {
      mover.taken = world_.occupancy.window(mover.footprint->corner.corner(mover.site));
    }
    return mover;
  }

  void move_contested();
  UpdateKey key(std::uint32_t id, Move move) const {
    return order_.key(id, world_.state.particles[id].previous, move, world_.state.step);
  }
  void rest(std::uint32_t id);

  // Particles that overlap, see engaged_step.cpp.
  void move_engaged(Lane& lane);
  void decide_engaged();
  void move_pushed();
  void yield_to_pushed(std::vector<Mover>& movers);

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
