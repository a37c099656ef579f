// Where the awake particles want to go.

#include <algorithm>
#include <atomic>

#include "automaton/engine/engine.hpp"

namespace clca::automaton {

namespace {

/// Particles that a thread takes at a time.
constexpr std::size_t kBatch = 512;

/// Work of a move that is not along gravity, where one along it is 1.
constexpr std::uint32_t kSlopingWork = 4;

}  // namespace

// Moves and awake particles are not in the same places, so threads help each other: each begins
// with the particles of its own strip.
void Engine::propose(StripWorker& worker) {
  for (std::size_t i = 0; i < workers_.size(); ++i) {
    examine_awake_of(worker, workers_[(worker.strip + i) % workers_.size()]);
  }
}

void Engine::examine_awake_of(StripWorker& worker, StripWorker& owner) {
  // All that are awake there have numbers, list after list; threads take them in batches.
  std::size_t list_begin = 0;
  const auto take_batches = [&](std::size_t size, auto examine_at) {
    std::atomic_ref next_awake(owner.next_awake);
    const std::size_t list_end = list_begin + size;
    std::size_t first = next_awake.load(std::memory_order_relaxed);
    while (first < list_end) {
      const std::size_t end = std::min(first + kBatch, list_end);
      if (next_awake.compare_exchange_weak(first, end, std::memory_order_relaxed)) {
        for (std::size_t i = first - list_begin; i < end - list_begin; ++i) {
          examine_at(i);
        }
        first = end;
      }
    }
    list_begin = list_end;
  };
  const auto is_first = [&](std::uint32_t id, lattice::Site at) {
    return owner.strip == 0 || !awake_in_earlier_strip(owner, id, at);
  };
  for (const StripWorker& finder : workers_) {
    const Proposals& proposals = finder.proposals_before[owner.strip];
    for (const auto* list : {&proposals.falling, &proposals.sloping}) {
      take_batches(list->size(), [&](std::size_t i) {
        const AwakeParticle awake = particle_after(list->begin()[i]);
        if (is_first(awake.id, awake.site)) {
          examine(worker, awake);
        }
      });
    }
  }
  const grains::State& state = world_.state;
  const std::span<const std::uint32_t> listed = owner.awake.listed();
  take_batches(listed.size(), [&](std::size_t i) {
    const std::uint32_t id = listed[i];
    const grains::Particle& particle = state.particles[id];
    // The strip that examines it may be writing `previous`: only that one reads it.
    if (particle.present && !(overlaps_ && world_.pushes.overlapping(id)) &&
        is_first(id, site_of(particle))) {
      examine(worker, {.site = site_of(particle),
                       .id = id,
                       .kind = particle.kind,
                       .previous = particle.previous});
    }
  });
}

// Several strips may have woken the same particle, but not far from their borders.
bool Engine::awake_in_earlier_strip(const StripWorker& worker, std::uint32_t id,
                                    lattice::Site at) const {
  const auto others =
      std::span(workers_).first(worker.inner_before.contains(at) ? 0 : worker.strip);
  return std::any_of(others.begin(), others.end(),
                     [&](const StripWorker& other) { return other.awake.contains(id); });
}

/// The particle of a proposal of the last step.
[[gnu::always_inline]] inline AwakeParticle Engine::particle_after(
    const MoveProposal& before) const {
  const lattice::Site step = step_of(before.site, before.move);
  return {.site = {world_.state.lattice.wrapped(before.site.column + step.column),
                   before.site.row + step.row},
          .id = before.id,
          .kind = before.kind,
          .previous = before.move};
}

grains::Move Engine::provisional_by_windows(const AwakeParticle& particle) const {
  const grains::OccupancyTable& occupancy = world_.occupancy;
  const WindowedFootprint& footprint = footprints_.of(particle.kind, particle.site.column);
  return decisions_.active().provisional(
      particle.id, particle.previous, world_.state.step, [&](lattice::Direction to) {
        if (wraps(particle.site)) {
          return world_.is_free(world_.state.particles[particle.id], to);
        }
        const auto& lead = footprint.lead_masks[index_of(to)];
        return std::none_of(lead.begin(), lead.end(), [&](const WindowMask& mask) {
          const Corner at = occupancy.corner(mask.corner(particle.site));
          return (occupancy.window(at) & mask.sites) != 0;
        });
      });
}

[[gnu::always_inline]] inline void Engine::examine(StripWorker& worker,
                                                   const AwakeParticle& particle) {
  ++worker.examined;
  const std::size_t strip = in_parallel_ ? strips_.of(particle.site) : 0;
  const WindowedFootprint& footprint = footprints_.of(particle.kind, particle.site.column);
  const bool wraps = this->wraps(particle.site);
  Corner at;
  std::uint64_t taken = 0;
  grains::Move move = grains::kRest;
  if (footprint.one_window && !wraps) {
    at = world_.occupancy.corner(footprint.corner_from(particle.site));
    taken = world_.occupancy.window(at);
    move = decisions_.active().provisional(
        particle.id, particle.previous, world_.state.step,
        [&](lattice::Direction to) { return (taken & footprint.windows[index_of(to)].lead) == 0; });
  } else {
    move = provisional_by_windows(particle);
  }
  if (move == grains::kRest) {
    world_.state.particles[particle.id].previous = grains::kRest;
    return;
  }
  const bool falls = move == static_cast<grains::Move>(world_.rules.gravity);
  if (records_work_) {
    worker.work.add(particle.site, falls ? 1 : kSlopingWork);
  }
  if (strip == worker.strip) {
    worker.waking.mark(particle.id);
  }
  const bool alone = !wraps && workers_[strip].inner.contains(particle.site);
  Proposals& proposals = worker.proposals[strip];
  // Field by field: to copy a whole proposal would wait for the writes to its parts.
  MoveProposal& proposal = (falls ? proposals.falling : proposals.sloping).add();
  proposal.site.column = particle.site.column;
  proposal.site.row = particle.site.row;
  proposal.taken = taken;
  proposal.byte = static_cast<std::uint32_t>(at.byte);
  proposal.id = particle.id;
  proposal.kind = particle.kind;
  proposal.contested = 0;
  proposal.move = move;
  proposal.access = alone ? grains::Access::exclusive : grains::Access::shared;
  proposal.outcome = ConflictOutcome::none;
}

}  // namespace clca::automaton
