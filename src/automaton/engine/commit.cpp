// Which movers want the same sites, and which of them get these; carrying out moves and waking the
// particles that may gain a free direction by them.

#include <algorithm>
#include <bit>

#include "automaton/engine/engine.hpp"

namespace clca::automaton {

namespace {

/// Number of windows whose particles are woken together, soon after they were changed.
constexpr std::size_t kWakeBatch = 64;

std::size_t site_index(const lattice::Lattice& lattice, const MoveProposal& proposal,
                       lattice::IndexOffset offset) {
  return lattice.shifted_index(lattice.index(proposal.site), proposal.site.column, offset);
}

/// The offset as an unsigned number: sums of indices wrap round.
std::size_t index_offset(std::int32_t offset) {
  return static_cast<std::size_t>(std::ptrdiff_t{offset});
}

void wake_owner(const World& world, StripWorker& worker, std::size_t index) {
  const grains::Owner owner = world.occupancy.load_owner(index);
  if (grains::is_particle(owner)) {
    worker.awake_next.insert(grains::particle_id(owner));
  }
}

void wake_by_sites(const World& world, StripWorker& worker, const MoveProposal& proposal,
                   const WindowedFootprint& footprint) {
  for (const lattice::IndexOffset offset : footprint.wake_sites[proposal.move]) {
    wake_owner(world, worker, site_index(world.state.lattice, proposal, offset));
  }
}

void change_sites(World& world, StripWorker& worker, const MoveProposal& proposal,
                  const WindowedFootprint& footprint) {
  grains::OccupancyTable& occupancy = world.occupancy;
  if (footprint.fits_one_window) {
    const MoveWindow& window = footprint.move_windows[proposal.move];
    occupancy.flip(window_corner(proposal, footprint), window.changed_sites, proposal.access);
    const std::uint64_t sites = proposal.taken_sites & window.wake_sites;
    worker.wake_windows.add_if(sites != 0, {footprint.corner_from(proposal.site), sites});
  } else {
    wake_by_sites(world, worker, proposal, footprint);
    for (const WindowMask& swapped : footprint.changed_masks[proposal.move]) {
      occupancy.flip(occupancy.corner(swapped.corner(proposal.site)), swapped.sites,
                     proposal.access);
    }
  }
  const std::size_t index = world.state.lattice.index(proposal.site);
  for (const ExchangeGroup& exchanges : footprint.exchanges[proposal.move]) {
    for (const Exchange exchange : exchanges) {
      occupancy.store_owner(index + index_offset(exchange.entered), grains::as_owner(proposal.id));
      occupancy.store_owner(index + index_offset(exchange.vacated), grains::kFree);
    }
  }
}

/// As change_sites(), but also across the periodic boundary.
void change_sites_one_by_one(World& world, StripWorker& worker, const MoveProposal& proposal,
                             const WindowedFootprint& footprint) {
  wake_by_sites(world, worker, proposal, footprint);
  const auto change = [&](const std::vector<lattice::IndexOffset>& offsets, grains::Owner owner) {
    for (const lattice::IndexOffset offset : offsets) {
      const std::size_t index = site_index(world.state.lattice, proposal, offset);
      world.occupancy.store_owner(index, owner);
      world.occupancy.flip(world.occupancy.corner(world.state.lattice.site(index)), 1,
                           proposal.access);
    }
  };
  change(footprint.lead_sites[proposal.move], grains::as_owner(proposal.id));
  change(footprint.trail_sites[proposal.move], grains::kFree);
}

std::uint32_t site_count(std::uint64_t sites) {
  return sites == 0 ? 0 : static_cast<std::uint32_t>(std::popcount(sites));
}

}  // namespace

// Movers in one direction never want the same site. So those along gravity, mostly the many,
// reserve nothing: they only look for the reservations of the others.
void Engine::reserve_sites(StripWorker& worker) {
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
        proposal.add_contested(site_count(both));
        contested_.set(at, both, proposal.access);
      }
    });
  });
}

std::uint32_t Engine::contested_count(const MoveProposal& proposal) const {
  std::uint32_t result = 0;
  for_each_lead(proposal, [&](Corner at, std::uint64_t sites) {
    result += site_count(contested_.window(at) & sites);
  });
  return result;
}

// A mover wins its contested sites if none of them has been won before; they are contested no more.
// One thread: contests near a cut and those that depend on them would need another phase.
void Engine::decide_contests() {
  turns_.clear();
  for (const StripWorker& worker : workers_) {
    const auto middle = static_cast<std::ptrdiff_t>(turns_.size());
    turns_.insert(turns_.end(), worker.queued_moves.begin(), worker.queued_moves.end());
    std::ranges::inplace_merge(turns_, turns_.begin() + middle, {}, &QueuedMove::key);
  }
  for (const QueuedMove& turn : turns_) {
    MoveProposal& proposal = *turn.proposal;
    if (contested_count(proposal) == proposal.contested_count) {
      proposal.outcome = ConflictOutcome::won;
      for_each_lead(proposal, [&](Corner at, std::uint64_t sites) { contested_.clear(at, sites); });
    }
  }
}

void Engine::end_conflicts(StripWorker& worker) {
  for (const QueuedMove& turn : worker.queued_moves) {
    for_each_lead(*turn.proposal, [&](Corner at, std::uint64_t) {
      contested_.clear_blocks(at, turn.proposal->access);
    });
    if (turn.proposal->outcome != ConflictOutcome::won) {
      turn.proposal->move = grains::kRest;
    }
  }
}

void Engine::commit(StripWorker& worker) {
  for_each_proposal(worker, &Proposals::falling,
                    [&](MoveProposal& proposal) { commit_unless_contested(worker, proposal); });
  for_each_proposal(worker, &Proposals::sloping, [&](MoveProposal& proposal) {
    proposal.add_contested(contested_count(proposal));  // none before: it slopes
    for_each_lead(proposal,
                  [&](Corner at, std::uint64_t) { reserved_.clear_blocks(at, proposal.access); });
    commit_unless_contested(worker, proposal);
  });
  wake_neighbours(worker);
  if (overlaps_) {
    give_turns_among_overlaps(worker);
  } else {
    std::ranges::sort(worker.queued_moves, {}, &QueuedMove::key);
  }
}

// A provisional target was free when the step began, and vacated sites are nobody's target. So a
// mover whose lead sites nobody else wants moves, whatever its position in the order.
void Engine::commit_unless_contested(StripWorker& worker, MoveProposal& proposal) {
  worker.awake_next.insert(proposal.id);  // moved or not: it is examined again
  if (proposal.contested_count > 0 || proposal.outcome == ConflictOutcome::overlapping) {
    worker.queued_moves.push_back(
        {update_key(world_.rules, world_.state, proposal.id, proposal.move), &proposal});
  } else {
    apply_move(worker, proposal);
  }
}

// The other moves may or may not have been carried out yet: only particles that stay where they are
// need to be woken, as movers are awake anyway, and their sites keep their owners.
void Engine::apply_move(StripWorker& worker, const MoveProposal& proposal) {
  const WindowedFootprint& footprint = footprints_.footprint(proposal.kind, proposal.site.column);
  if (wraps(proposal.site)) {
    change_sites_one_by_one(world_, worker, proposal, footprint);
  } else {
    change_sites(world_, worker, proposal, footprint);
  }
  grains::Particle& particle = world_.state.particles[proposal.id];
  const lattice::Site to = proposal.site + unit(static_cast<lattice::Direction>(proposal.move));
  if (world_.state.lattice.periodic()) {
    particle.column += to.column - proposal.site.column;  // not wrapped
  } else {
    particle.column = to.column;  // without reading it first
  }
  particle.row = to.row;
  particle.previous = proposal.move;
  if (worker.wake_windows.size() >= kWakeBatch) {
    wake_neighbours(worker);
  }
}

void Engine::move_or_rest(StripWorker& worker, const MoveProposal& proposal) {
  if (proposal.outcome == ConflictOutcome::won) {
    apply_move(worker, proposal);
  } else {
    world_.state.particles[proposal.id].previous = grains::kRest;
  }
}

void Engine::wake_neighbours(StripWorker& worker) {
  const lattice::Lattice& lattice = world_.state.lattice;
  for (const WakeWindow& window : worker.wake_windows) {
    for (std::uint64_t sites = window.sites; sites != 0; sites &= sites - 1) {
      const int bit = std::countr_zero(sites);
      wake_owner(world_, worker,
                 lattice.index({window.corner.column + bit % grains::kWindow,
                                window.corner.row + bit / grains::kWindow}));
    }
  }
  worker.wake_windows.clear();
}

void Engine::finish(StripWorker& worker) {
  if (!overlaps_) {
    for (const QueuedMove& turn : worker.queued_moves) {
      move_or_rest(worker, *turn.proposal);
    }
  }
  wake_neighbours(worker);
  end_conflicts(worker);
}

}  // namespace clca::automaton
