// The provisional directions of the awake particles.

#include <algorithm>
#include <atomic>

#include "automaton/engine/engine.hpp"

namespace clca::automaton {

namespace {

/// Particles that a thread takes at a time.
constexpr std::size_t kBatch = 512;

/// How many particles before its turn a particle is fetched from memory.
constexpr std::size_t kAhead = 16;

/// Work of a move that is not along gravity, where one along it is 1.
constexpr std::uint32_t kSlopingWork = 4;

}  // namespace

// Moves and awake particles are not in the same regions, so threads help each other: each begins
// with the particles of its own strip.
void Engine::propose(StripWorker& worker) {
  for (std::size_t i = 0; i < workers_.size(); ++i) {
    examine_awake_of(worker, workers_[(worker.strip + i) % workers_.size()]);
  }
}

void Engine::examine_awake_of(StripWorker& worker, StripWorker& owner) {
  const std::span<const std::uint32_t> listed = owner.awake.ids();
  std::atomic_ref next_awake(owner.next_awake);
  while (true) {
    const std::size_t first = next_awake.fetch_add(kBatch, std::memory_order_relaxed);
    if (first >= listed.size()) {
      return;
    }
    const std::size_t end = std::min(first + kBatch, listed.size());
    for (std::size_t i = first; i < end; ++i) {
      __builtin_prefetch(&world_.state.particles[listed[std::min(i + kAhead, end - 1)]]);
      const std::uint32_t id = listed[i];
      const grains::Particle& particle = world_.state.particles[id];
      // The strip that examines it may be writing `previous`: only that one reads it.
      if (particle.present && !(overlaps_ && world_.is_overlapping(id)) &&
          (owner.strip == 0 || !awake_in_earlier_strip(owner, id, site_of(particle)))) {
        examine(worker, id, site_of(particle));
      }
    }
  }
}

// Several strips may have woken the same particle, but not far from their borders.
bool Engine::awake_in_earlier_strip(const StripWorker& worker, std::uint32_t id,
                                    lattice::Site at) const {
  const auto others =
      std::span(workers_).first(worker.inner_before.contains(at) ? 0 : worker.strip);
  return std::ranges::any_of(others,
                             [&](const StripWorker& other) { return other.awake.contains(id); });
}

grains::Move Engine::provisional_by_windows(std::uint32_t id, lattice::Site site) const {
  const grains::OccupancyTable& occupancy = world_.occupancy;
  const grains::Particle& particle = world_.state.particles[id];
  const WindowedFootprint& footprint = footprints_.footprint(particle.kind, site.column);
  const auto is_free = [&](lattice::Direction to) {
    if (wraps(site)) {
      return world_.box.is_free(particle, to);
    }
    const auto& lead = footprint.lead_masks[index_of(to)];
    return std::ranges::none_of(lead, [&](const WindowMask& mask) {
      const Corner at = occupancy.corner(mask.corner(site));
      return (occupancy.window(at) & mask.sites) != 0;
    });
  };
  return active_.provisional_move(id, particle.previous, world_.state.step, is_free);
}

[[gnu::always_inline]] inline void Engine::examine(StripWorker& worker, std::uint32_t id,
                                                   lattice::Site site) {
  ++worker.examined_count;
  const std::size_t strip = in_parallel_ ? strips_.strip_of(site) : 0;
  grains::Particle& particle = world_.state.particles[id];
  const WindowedFootprint& footprint = footprints_.footprint(particle.kind, site.column);
  const bool wraps = this->wraps(site);
  Corner at;
  std::uint64_t taken = 0;
  grains::Move move = grains::kRest;
  if (footprint.fits_one_window && !wraps) {
    at = world_.occupancy.corner(footprint.corner_from(site));
    taken = world_.occupancy.window(at);
    move = active_.provisional_move(
        id, particle.previous, world_.state.step, [&](lattice::Direction to) {
          return (taken & footprint.move_windows[index_of(to)].lead_sites) == 0;
        });
  } else {
    move = provisional_by_windows(id, site);
  }
  if (move == grains::kRest) {
    particle.previous = grains::kRest;
    return;
  }
  const bool falls = move == static_cast<grains::Move>(world_.rules.gravity);
  if (records_work_) {
    worker.work.add(site, falls ? 1 : kSlopingWork);
  }
  const bool alone = !wraps && workers_[strip].inner.contains(site);
  Proposals& proposals = worker.proposals[strip];
  // Field by field: to copy a whole proposal would wait for the writes to its parts.
  MoveProposal& proposal = (falls ? proposals.falling : proposals.sloping).add();
  proposal.site.column = site.column;
  proposal.site.row = site.row;
  proposal.taken_sites = taken;
  proposal.corner_byte = static_cast<std::uint32_t>(at.byte);
  proposal.id = id;
  proposal.kind = particle.kind;
  proposal.contested_count = 0;
  proposal.move = move;
  proposal.access = alone ? grains::Access::exclusive : grains::Access::shared;
  proposal.outcome = ConflictOutcome::none;
}

}  // namespace clca::automaton
