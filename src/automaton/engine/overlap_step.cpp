// The part of a step that concerns particles which overlap. They are few: one thread, in order.

#include <algorithm>

#include "automaton/engine/engine.hpp"

namespace clca::automaton {

// All have chosen their direction from the state at the start of the step when the first one moves.
void Engine::move_overlapping() {
  // If nothing has moved or changed since all overlapping particles rested, they rest again.
  if (nothing_moved_ && !world_.changes.by_others && sleeping_) {
    return;
  }
  Movers movers = chosen_moves(world_.overlapping_particles());
  overlap_proposals_.clear();
  for (const ProposedMove& move : movers.others) {
    overlap_proposals_.push_back(overlapping_proposal(move));
  }
  give_turns(movers.pushed, &try_move_pushed);
  StripWorker& worker = workers_.front();
  Proposals& proposals = worker.proposals.front();
  yield_to_pushed(proposals.falling);
  yield_to_pushed(proposals.sloping);
  for (MoveProposal& proposal : overlap_proposals_) {
    proposal.outcome = ConflictOutcome::overlapping;
    proposals.sloping.add(proposal);
  }
}

MoveProposal Engine::overlapping_proposal(const ProposedMove& move) const {
  const std::uint32_t id = move.key.id;
  const grains::Particle& particle = world_.state.particles[id];
  const lattice::Site site = site_of(particle);
  const WindowedFootprint& footprint = footprints_.footprint(particle.kind, particle.column);
  const bool by_window = footprint.fits_one_window && !wraps(site);
  const std::size_t byte =
      by_window ? world_.occupancy.corner(footprint.corner_from(site)).byte : 0;
  return {.site = site,
          .id = id,
          .corner_byte = static_cast<std::uint32_t>(byte),
          .kind = particle.kind,
          .move = static_cast<grains::Move>(move.direction)};
}

// Pushed particles have moved. Some of the others find their way taken; some overlap now, and have
// their turn all the same.
void Engine::yield_to_pushed(ReusableBuffer<MoveProposal>& proposals) {
  grains::State& state = world_.state;
  proposals.erase_if([&](const MoveProposal& proposal) {
    if (world_.is_overlapping(proposal.id)) {
      overlap_proposals_.push_back(proposal);
      return true;
    }
    grains::Particle& particle = state.particles[proposal.id];
    if (!world_.box.is_free(particle, static_cast<lattice::Direction>(proposal.move))) {
      particle.previous = grains::kRest;
      workers_.front().awake_next.insert(proposal.id);  // it may have another way
      return true;
    }
    return false;
  });
}

void Engine::give_turns_among_overlaps(StripWorker& worker) {
  std::ranges::sort(worker.queued_moves, {}, &QueuedMove::key);
  for (const QueuedMove& turn : worker.queued_moves) {
    MoveProposal& proposal = *turn.proposal;
    const auto direction = static_cast<lattice::Direction>(proposal.move);
    if (proposal.outcome != ConflictOutcome::overlapping) {
      const bool free = world_.box.is_free(world_.state.particles[proposal.id], direction);
      proposal.outcome = free ? ConflictOutcome::won : ConflictOutcome::none;
      move_or_rest(worker, proposal);
    } else if (try_move_by_itself(world_, proposal.id, direction)) {
      proposal.outcome = ConflictOutcome::won;
    } else {
      world_.state.particles[proposal.id].previous = grains::kRest;
    }
  }
}

}  // namespace clca::automaton
