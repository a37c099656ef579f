// Which movers want the same sites, and which of them get these.

#include <algorithm>
#include <bit>

#include "automaton/engine/engine.hpp"

namespace clca::automaton {

namespace {

std::uint16_t count(std::uint64_t sites) {
  return sites == 0 ? 0 : static_cast<std::uint16_t>(std::popcount(sites));
}

}  // namespace

// Movers in one direction never want the same site. So those along gravity, mostly the many,
// reserve nothing: they only look for the reservations of the others.
void Engine::reserve(StripWorker& worker) {
  for (StripWorker& each : in_parallel_ ? std::span(&worker, 1) : std::span(workers_)) {
    each.awake.clear();  // all are examined
    each.next_awake = 0;
  }
  for_each_proposal(worker, &Proposals::sloping, [&](const MoveProposal& proposal) {
    for_each_lead(proposal, [&](Corner at, std::uint64_t sites) {
      reservations_.reserve(at, sites, proposal.access);
    });
  });
}

void Engine::find_conflicts(StripWorker& worker) {
  for_each_proposal(worker, &Proposals::falling, [&](MoveProposal& proposal) {
    for_each_lead(proposal, [&](Corner at, std::uint64_t sites) {
      if (const std::uint64_t both = reservations_.reserved(at) & sites; both != 0) {
        proposal.contested += count(both);
        reservations_.contest(at, both, proposal.access);
      }
    });
  });
}

std::uint16_t Engine::contested_lead(const MoveProposal& proposal) const {
  std::uint16_t result = 0;
  for_each_lead(proposal, [&](Corner at, std::uint64_t sites) {
    result = static_cast<std::uint16_t>(result + count(reservations_.contested(at) & sites));
  });
  return result;
}

// A mover wins its contested sites if none of them has been won before.
void Engine::give_turn(MoveProposal& proposal) {
  if (contested_lead(proposal) == proposal.contested) {
    proposal.outcome = ConflictOutcome::won;
    for_each_lead(proposal, [&](Corner at, std::uint64_t sites) { reservations_.win(at, sites); });
  }
}

bool Engine::depends_on_deferred(const MoveProposal& proposal) const {
  bool depends = false;
  for_each_lead(proposal, [&](Corner at, std::uint64_t sites) {
    depends = depends || (reservations_.deferred(at) & sites) != 0;
  });
  return depends;
}

// A contested move is deferred if it is near another strip, or if a deferred move that comes before
// it wants one of its sites.
void Engine::give_turns(StripWorker& worker) {
  std::sort(worker.turns.begin(), worker.turns.end());
  for (const QueuedMove& turn : worker.turns) {
    MoveProposal& proposal = *turn.proposal;
    const bool deferred = proposal.access == grains::Access::shared ||
                          (!worker.deferred.empty() && depends_on_deferred(proposal));
    if (deferred) {
      for_each_lead(proposal, [&](Corner at, std::uint64_t sites) {
        reservations_.defer(at, sites, proposal.access);
      });
      worker.deferred.push_back(turn);
    } else {
      give_turn(proposal);
      apply_or_rest(worker, proposal);
    }
  }
}

void Engine::give_deferred_turns() {
  deferred_.clear();
  for (const StripWorker& worker : busy()) {
    const auto middle = static_cast<std::ptrdiff_t>(deferred_.size());
    deferred_.insert(deferred_.end(), worker.deferred.begin(), worker.deferred.end());
    std::inplace_merge(deferred_.begin(), deferred_.begin() + middle, deferred_.end());
  }
  for (const QueuedMove& turn : deferred_) {
    give_turn(*turn.proposal);
  }
}

void Engine::end_conflicts(StripWorker& worker) {
  for (const QueuedMove& turn : worker.turns) {
    for_each_lead(*turn.proposal, [&](Corner at, std::uint64_t) {
      reservations_.end_contest(at, turn.proposal->access);
    });
  }
  for (const QueuedMove& turn : worker.deferred) {
    for_each_lead(*turn.proposal, [&](Corner at, std::uint64_t) {
      reservations_.end_deferral(at, grains::Access::shared);
    });
  }
  for (const QueuedMove& turn : worker.turns) {
    if (turn.proposal->outcome != ConflictOutcome::won) {
      turn.proposal->move = grains::kRest;
    }
  }
}

}  // namespace clca::automaton
