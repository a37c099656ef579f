// Where those who are awake want to go, as one thread finds out.

#include <algorithm>
#include <atomic>

#include "automaton/stepper.hpp"

namespace clca::automaton {

namespace {

/// Ids that are sorted by kind together.
constexpr std::size_t kBatch = 512;

/// What a move costs that is not along gravity, where one along it costs 1.
constexpr std::uint32_t kSlopingLoad = 4;

}  // namespace

// Far from the borders of its strip of the step before, only its own thread has woken a particle.
bool Stepper::dealt_elsewhere(const Lane& whose, std::uint32_t id, lattice::Site at) const {
  const auto others = std::span(lanes_).first(whose.inner_before.contains(at) ? 0 : whose.strip);
  return std::any_of(others.begin(), others.end(),
                     [&](const Lane& other) { return other.awake.contains(id); });
}

bool Stepper::lead_is_free(const Mover& mover, lattice::Direction to) const {
  if (mover.access == Access::seam) {
    return world_.is_free(world_.state.particles[mover.id], to);
  }
  const grains::Occupancy& occupancy = world_.occupancy;
  const grains::Footprint& footprint = world_.footprints.of(mover.kind, mover.site.column);
  if (footprint.one_window) {
    const grains::SiteBits::Corner at = occupancy.corner(footprint.corner_from(mover.site));
    return (occupancy.window(at) & footprint.windows[index_of(to)].lead) == 0;
  }
  const auto& lead = footprint.lead_patches[index_of(to)];
  return std::none_of(lead.begin(), lead.end(), [&](const grains::Patch& patch) {
    const grains::SiteBits::Corner at = occupancy.corner(patch.corner(mover.site));
    return (occupancy.window(at) & patch.sites) != 0;
  });
}

[[gnu::always_inline]] inline Candidate Stepper::candidate(const Mover& before) const {
  const lattice::Site step = step_of(before.site, before.move);
  return {.site = {world_.state.lattice.wrapped(before.site.column + step.column),
                   before.site.row + step.row},
          .id = before.id,
          .kind = before.kind,
          .previous = before.move};
}

Access Stepper::access(lattice::Site site, std::size_t strip) const {
  if (strips_.at_seam(site)) {
    return Access::seam;
  }
  return lanes_[strip].inner.contains(site) ? Access::alone : Access::shared;
}

grains::Move Stepper::provisional_by_parts(Candidate candidate, Access access) const {
  const Mover mover = {
      .site = candidate.site, .id = candidate.id, .kind = candidate.kind, .access = access};
  return rule_.provisional(candidate.id, candidate.previous, world_.state.step,
                           [&](lattice::Direction to) { return lead_is_free(mover, to); });
}

[[gnu::always_inline]] inline void Stepper::decide(Lane& lane, const Candidate& candidate) {
  ++lane.looked_at;
  const std::size_t strip = in_parallel_ ? strips_.of(candidate.site) : 0;
  const Access access = this->access(candidate.site, strip);
  const grains::Footprint& footprint = world_.footprints.of(candidate.kind, candidate.site.column);
  grains::SiteBits::Corner at;
  std::uint64_t taken = 0;
  grains::Move move = grains::kRest;
  if (footprint.one_window && access != Access::seam) {
    at = world_.occupancy.corner(footprint.corner_from(candidate.site));
    taken = world_.occupancy.window(at);
    move = rule_.provisional(
        candidate.id, candidate.previous, world_.state.step,
        [&](lattice::Direction to) { return (taken & footprint.windows[index_of(to)].lead) == 0; });
  } else {
    move = provisional_by_parts(candidate, access);
  }
  if (move == grains::kRest) {
    world_.state.particles[candidate.id].previous = grains::kRest;
    return;
  }
  const bool falls = move == static_cast<grains::Move>(world_.rules.gravity);
  if (notes_load_) {
    lane.load.note(candidate.site, falls ? 1 : kSlopingLoad);
  }
  if (strip == lane.strip) {
    lane.waking.mark(candidate.id);
  }
  Movers& movers = lane.movers[strip];
  // In place: a block of memory whose parts have just been written would have to be waited for.
  Mover& mover = (falls ? movers.falling : movers.sloping).add();
  mover.site.column = candidate.site.column;
  mover.site.row = candidate.site.row;
  mover.taken = taken;
  mover.byte = static_cast<std::uint32_t>(at.byte);
  mover.id = candidate.id;
  mover.kind = candidate.kind;
  mover.contested = 0;
  mover.move = move;
  mover.previous = candidate.previous;
  mover.access = access;
  mover.standing = Standing::usual;
}

// Where there is most to look at is not where most moves, so threads help each other: each begins
// with those that it has woken itself.
void Stepper::look(Lane& lane) {
  for (std::size_t i = 0; i < lanes_.size(); ++i) {
    look_at(lane, lanes_[(lane.strip + i) % lanes_.size()]);
  }
}

void Stepper::look_at(Lane& lane, Lane& whose) {
  std::size_t dealt_before = 0;
  /// Calls `look` for parts of the next `count` of all that are awake there.
  const auto deal = [&](std::size_t count, auto look) {
    std::atomic_ref dealt(whose.dealt);
    const std::size_t end = dealt_before + count;
    std::size_t first = dealt.load(std::memory_order_relaxed);
    while (first < end) {
      const std::size_t part = std::min(first + kBatch, end);
      if (dealt.compare_exchange_weak(first, part, std::memory_order_relaxed)) {
        look(first - dealt_before, part - first);
        first = part;
      }
    }
    dealt_before = end;
  };
  for (const Lane& finder : lanes_) {
    const Movers& movers = finder.movers_before[whose.strip];
    for (const Bag<Mover>* list : {&movers.falling, &movers.sloping}) {
      deal(list->size(), [&](std::size_t first, std::size_t count) {
        for (const Mover& before : std::span(list->begin(), list->end()).subspan(first, count)) {
          const Candidate candidate = this->candidate(before);
          if (whose.strip == 0 || !dealt_elsewhere(whose, candidate.id, candidate.site)) {
            decide(lane, candidate);
          }
        }
      });
    }
  }
  const std::span<const std::uint32_t> listed = whose.awake.listed();
  deal(listed.size(), [&](std::size_t first, std::size_t count) {
    look_at_listed(lane, whose, listed.subspan(first, count));
  });
}

// Kind after kind: what a processor guesses of the way through the lists of sites is right then.
void Stepper::look_at_listed(Lane& lane, const Lane& whose, std::span<const std::uint32_t> ids) {
  const grains::State& state = world_.state;
  for (const std::uint32_t id : ids) {
    const bool engaged = !state.pushes.empty() && world_.pushes.engaged(id);
    lane.of_kind[state.particles[id].kind].add_if(state.particles[id].present && !engaged, id);
  }
  for (Bag<std::uint32_t>& alike : lane.of_kind) {
    for (const std::uint32_t id : alike) {
      const grains::Particle& particle = state.particles[id];
      const lattice::Site site = site_of(particle);
      // Who looks at it may already change the rest.
      if (whose.strip == 0 || !dealt_elsewhere(whose, id, site)) {
        decide(lane,
               {.site = site, .id = id, .kind = particle.kind, .previous = particle.previous});
      }
    }
    alike.clear();
  }
}

}  // namespace clca::automaton
