#pragma once
// The particles' own moves of one step, fast: points 3 and 4 of "One step" in docs/model.md.

#include <vector>

#include "automaton/engine/strips.hpp"
#include "clca/automaton/automaton.hpp"
#include "clca/parallel/team.hpp"

namespace clca::automaton {

/// Comes to the same states as ReferenceMechanics. Only particles that may have gained a free
/// direction are examined, only moves that conflict with others are sorted, and each thread works
/// on a strip of the box. "Why the parallel step equals the sequential one" in docs/model.md says
/// why that is enough.
class Engine final : public AutomatonMechanics {
 public:
  Engine(grains::State initial, const Rules& rules, const Options& options);

 private:
  /// Position of a window of 8 x 8 sites.
  using Corner = grains::Bitboard::Corner;

  /// Calls `visit` with the proposals in a strip, whichever worker has found them.
  template <class Visit>
  void for_each_proposal(const StripWorker& worker, ReusableBuffer<MoveProposal> Proposals::*list,
                         Visit visit) {
    for (StripWorker& finder : workers_) {
      for (MoveProposal& proposal : finder.proposals[worker.strip].*list) {
        visit(proposal);
      }
    }
  }
  lattice::Site site_of(const grains::Particle& particle) const {
    return {world_.state.lattice.wrapped(particle.column), particle.row};
  }
  /// Whether a particle there has to be handled site by site, as windows do not wrap.
  bool wraps(lattice::Site site) const { return strips_.at_periodic_boundary(site); }

  std::size_t move_particles() override;
  void append_moved(std::vector<std::uint32_t>& ids) const override;

  // Before the phases.
  void begin_step();
  /// Wakes particles where walls, sources, outlets or overlaps changed; all, if none sleep.
  void wake_changed();
  void wake_upstream(lattice::Site vacated);
  void wake(std::uint32_t id);
  void assign_strips();

  // The phases. Each begins when all workers have ended the one before.
  void run_phases(parallel::FirstFailure& failure);
  void in_each_strip(parallel::FirstFailure& failure, void (Engine::*phase)(StripWorker&));

  // Provisional directions, see proposals.cpp.
  void propose(StripWorker& worker);
  void examine_awake_of(StripWorker& worker, StripWorker& owner);
  bool awake_in_earlier_strip(const StripWorker& worker, std::uint32_t id, lattice::Site at) const;
  void examine(StripWorker& worker, std::uint32_t id, lattice::Site site);
  grains::Move provisional_by_windows(std::uint32_t id, lattice::Site site) const;

  // Particles that overlap, see overlap_step.cpp.
  void move_overlapping();
  MoveProposal overlapping_proposal(const ProposedMove& move) const;
  void yield_to_pushed(ReusableBuffer<MoveProposal>& proposals);
  void give_turns_among_overlaps(StripWorker& worker);

  // Conflicts, carrying out moves and waking, see commit.cpp.
  /// Calls `visit` with the corner of each window that has lead sites, and these sites.
  template <class Visit>
  void for_each_lead(const MoveProposal& proposal, Visit visit) const;
  void reserve_sites(StripWorker& worker);
  void find_conflicts(StripWorker& worker);
  std::uint32_t contested_count(const MoveProposal& proposal) const;
  void decide_contests();
  void end_conflicts(StripWorker& worker);
  void commit(StripWorker& worker);
  void commit_unless_contested(StripWorker& worker, MoveProposal& proposal);
  void apply_move(StripWorker& worker, const MoveProposal& proposal);
  void move_or_rest(StripWorker& worker, const MoveProposal& proposal);
  void wake_neighbours(StripWorker& worker);
  void finish(StripWorker& worker);

  int threads_;
  std::size_t parallel_from_;
  bool sleeping_;
  WindowedFootprints footprints_;
  // Lead sites that some mover has reserved in this step, and those that more than one wants. The
  // order of changes within a phase does not matter.
  grains::Bitboard reserved_;
  grains::Bitboard contested_;
  Strips strips_;
  // On one thread the first worker has the whole box, and the lists of the others are empty.
  std::vector<StripWorker> workers_;
  std::vector<QueuedMove> turns_;                // contested moves of all workers
  std::vector<MoveProposal> overlap_proposals_;  // of those that move by themselves
  std::size_t examined_;                         // number of particles in the last step
  // This step:
  bool in_parallel_ = false;
  bool overlaps_ = false;      // some particles overlap
  bool records_work_ = false;  // for Strips
  // The last step:
  bool nothing_moved_ = false;  // and no overlapping particle in the step before that
};

template <class Visit>
[[gnu::always_inline]] inline void Engine::for_each_lead(const MoveProposal& proposal,
                                                         Visit visit) const {
  const WindowedFootprint& footprint = footprints_.footprint(proposal.kind, proposal.site.column);
  if (wraps(proposal.site)) {
    const lattice::Lattice& lattice = world_.state.lattice;
    const std::size_t index = lattice.index(proposal.site);
    for (const lattice::IndexOffset offset : footprint.lead_sites[proposal.move]) {
      const std::size_t lead = lattice.shifted_index(index, proposal.site.column, offset);
      visit(world_.occupancy.corner(lattice.site(lead)), std::uint64_t{1});
    }
  } else if (footprint.fits_one_window) {
    visit(window_corner(proposal, footprint), footprint.move_windows[proposal.move].lead_sites);
  } else {
    for (const WindowMask& lead : footprint.lead_masks[proposal.move]) {
      visit(world_.occupancy.corner(lead.corner(proposal.site)), lead.sites);
    }
  }
}

}  // namespace clca::automaton
