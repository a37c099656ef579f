// The part of a step that concerns particles which overlap. They are few: one thread, in order.

#include <algorithm>

#include "automaton/engine/engine.hpp"

namespace clca::automaton {

// All have chosen their direction from the state at the start of the step when the first one moves.
void Engine::move_overlapping() {
  // Where nothing has moved or changed since all that overlap chose to rest, they rest again.
  if (nothing_moved_ && !world_.changes.by_others && sleeping_) {
    return;
  }
  propose_overlapping();
  move_pushed();
  StripWorker& worker = workers_.front();
  Proposals& proposals = worker.proposals.front();
  yield_to_pushed(proposals.falling);
  yield_to_pushed(proposals.sloping);
  for (MoveProposal& proposal : freed_) {
    proposal.outcome = ConflictOutcome::overlapping;
    proposals.sloping.add(proposal);
  }
}

void Engine::propose_overlapping() {
  pushed_.clear();
  freed_.clear();
  grains::State& state = world_.state;
  std::vector<std::uint32_t> resting;
  for (const std::uint32_t id : PushList::overlapping_particles(state)) {
    quiet_ = quiet_ && state.particles[id].previous == grains::kRest;
    const grains::Move move = decisions_.provisional(id);
    if (move == grains::kRest) {
      resting.push_back(id);
    } else {
      (PushList::onto(state, id).empty() ? freed_ : pushed_)
          .push_back(overlapping_proposal(id, move));
    }
  }
  for (const std::uint32_t id : resting) {
    state.particles[id].previous = grains::kRest;
  }
}

MoveProposal Engine::overlapping_proposal(std::uint32_t id, grains::Move move) const {
  const grains::Particle& particle = world_.state.particles[id];
  const lattice::Site site = site_of(particle);
  const WindowedFootprint& footprint = footprints_.of(particle.kind, particle.column);
  const bool by_window = footprint.one_window && !wraps(site);
  const std::size_t byte =
      by_window ? world_.occupancy.corner(footprint.corner_from(site)).byte : 0;
  return {.site = site,
          .id = id,
          .byte = static_cast<std::uint32_t>(byte),
          .kind = particle.kind,
          .move = move,
          .outcome = ConflictOutcome::overlapping};
}

void Engine::move_pushed() {
  std::vector<QueuedMove> turns;
  for (MoveProposal& proposal : pushed_) {
    turns.push_back({decisions_.key(proposal.id, proposal.move), &proposal});
  }
  std::sort(turns.begin(), turns.end());
  std::vector<MoveProposal> moved;
  for (const auto& [key, proposal] : turns) {
    if (decisions_.move_pushed(proposal->id, static_cast<lattice::Direction>(proposal->move))) {
      moved.push_back(*proposal);
    } else {
      world_.state.particles[proposal->id].previous = grains::kRest;
    }
  }
  pushed_ = std::move(moved);
}

// Pushed particles have moved. Some of the others find their way taken; some overlap now, and have
// their turn all the same.
void Engine::yield_to_pushed(ReusableBuffer<MoveProposal>& proposals) {
  grains::State& state = world_.state;
  proposals.erase_if([&](const MoveProposal& proposal) {
    if (world_.pushes.overlapping(proposal.id)) {
      freed_.push_back(proposal);
      return true;
    }
    grains::Particle& particle = state.particles[proposal.id];
    if (!world_.is_free(particle, static_cast<lattice::Direction>(proposal.move))) {
      particle.previous = grains::kRest;
      workers_.front().waking.insert(proposal.id);  // it may have another way
      return true;
    }
    return false;
  });
}

void Engine::give_turns_among_overlaps(StripWorker& worker) {
  std::sort(worker.turns.begin(), worker.turns.end());
  for (const QueuedMove& turn : worker.turns) {
    MoveProposal& proposal = *turn.proposal;
    const auto direction = static_cast<lattice::Direction>(proposal.move);
    if (proposal.outcome != ConflictOutcome::overlapping) {
      const bool free = world_.is_free(world_.state.particles[proposal.id], direction);
      proposal.outcome = free ? ConflictOutcome::won : ConflictOutcome::none;
      apply_or_rest(worker, proposal);
    } else if (decisions_.move(proposal.id, direction)) {
      proposal.outcome = ConflictOutcome::won;
    } else {
      world_.state.particles[proposal.id].previous = grains::kRest;
    }
  }
}

}  // namespace clca::automaton
