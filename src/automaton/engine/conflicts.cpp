// Which movers want the same sites, and which of them get these.

#include <algorithm>
#include <bit>

#include "automaton/engine/engine.hpp"

namespace clca::automaton {

namespace {

std::uint32_t count(std::uint64_t sites) {
  return sites == 0 ? 0 : static_cast<std::uint32_t>(std::popcount(sites));
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
      if (const std::uint64_t both = reserved_.set(at, sites, proposal.access); both != 0) {
        contested_.set(at, both, proposal.access);
      }
    });
  });
}

void Engine::find_conflicts(StripWorker& worker) {
  for_each_proposal(worker, &Proposals::falling, [&](MoveProposal& proposal) {
    for_each_lead(proposal, [&](Corner at, std::uint64_t sites) {
      if (const std::uint64_t both = reserved_.window(at) & sites; both != 0) {
        proposal.contest(count(both));
        contested_.set(at, both, proposal.access);
      }
    });
  });
}

std::uint32_t Engine::contested_lead(const MoveProposal& proposal) const {
  std::uint32_t result = 0;
  for_each_lead(proposal, [&](Corner at, std::uint64_t sites) {
    result += count(contested_.window(at) & sites);
  });
  return result;
}

// A mover wins its contested sites if none of them has been won before; they are contested no more.
void Engine::decide_contest(MoveProposal& proposal) {
  if (contested_lead(proposal) == proposal.contested) {
    proposal.outcome = ConflictOutcome::won;
    for_each_lead(proposal, [&](Corner at, std::uint64_t sites) { contested_.clear(at, sites); });
  }
}

// One thread: contests near a cut and those that depend on them would need another phase.
void Engine::decide_contests() {
  turns_.clear();
  for (const StripWorker& worker : busy()) {
    const auto middle = static_cast<std::ptrdiff_t>(turns_.size());
    turns_.insert(turns_.end(), worker.turns.begin(), worker.turns.end());
    std::ranges::inplace_merge(turns_, turns_.begin() + middle, {}, &QueuedMove::key);
  }
  for (const QueuedMove& turn : turns_) {
    decide_contest(*turn.proposal);
  }
}

void Engine::end_conflicts(StripWorker& worker) {
  for (const QueuedMove& turn : worker.turns) {
    for_each_lead(*turn.proposal, [&](Corner at, std::uint64_t) {
      contested_.clear_blocks(at, turn.proposal->access);
    });
  }
  for (const QueuedMove& turn : worker.turns) {
    if (turn.proposal->outcome != ConflictOutcome::won) {
      turn.proposal->move = grains::kRest;
    }
  }
}

}  // namespace clca::automaton
