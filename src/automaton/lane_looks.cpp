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

/// From registers: a block of memory whose parts have just been written would have to be waited
/// for.
void copy_by_fields(const Mover& from, Mover& to) {
  to.site.column = from.site.column;
  to.site.row = from.site.row;
  to.footprint = from.footprint;
  to.at.byte = from.at.byte;
  to.at.column = from.at.column;
  to.taken = from.taken;
  to.id = from.id;
  to.strip = from.strip;
  to.move = from.move;
  to.access = from.access;
  to.engaged = from.engaged;
  to.won = from.won;
  to.contested = from.contested;
}

}  // namespace

// Where there is most to look at is not where most moves, so threads help each other: each begins
// with those that it has woken itself.
void Stepper::look(Lane& lane) {
  for (std::size_t i = 0; i < lanes_.size(); ++i) {
    look_at(lane, lanes_[(lane.strip + i) % lanes_.size()]);
  }
}

// Kind after kind: what a processor guesses of the way through the lists of sites is right then.
void Stepper::look_at(Lane& lane, Lane& whose) {
  const std::span<const std::uint32_t> ids = whose.awake.ids();
  std::atomic_ref dealt(whose.dealt);
  while (dealt.load(std::memory_order_relaxed) < ids.size()) {
    const std::size_t first =
        std::min(dealt.fetch_add(kBatch, std::memory_order_relaxed), ids.size());
    for (const std::uint32_t id : ids.subspan(first, std::min(kBatch, ids.size() - first))) {
      lane.of_kind[world_.state.particles[id].kind].add(id);
    }
    for (Bag<std::uint32_t>& alike : lane.of_kind) {
      for (const std::uint32_t id : alike) {
        decide(lane, whose, id);
      }
      alike.clear();
    }
  }
}

// Far from the borders of its strip of the step before, only its own thread has woken a particle.
bool Stepper::dealt_elsewhere(const Lane& whose, std::uint32_t id, lattice::Site at) const {
  const auto others = std::span(lanes_).first(whose.inner_before.contains(at) ? 0 : whose.strip);
  return std::any_of(others.begin(), others.end(),
                     [id](const Lane& other) { return other.awake.contains(id); });
}

bool Stepper::lead_is_free(const Mover& mover, lattice::Direction to) const {
  if (mover.access == Access::seam) {
    return world_.is_free(world_.state.particles[mover.id], to);
  }
  const Occupancy& occupancy = world_.occupancy;
  const Footprint& footprint = *mover.footprint;
  if (footprint.one_window) {
    return (occupancy.window(mover.at) & footprint.windows[index_of(to)].lead) == 0;
  }
  const auto& lead = footprint.lead_patches[index_of(to)];
  return std::none_of(lead.begin(), lead.end(), [&](const Patch& patch) {
    const SiteBits::Corner at = occupancy.corner(patch.corner(mover.site));
    return (occupancy.window(at) & patch.sites) != 0;
  });
}

Move Stepper::provisional_by_parts(const Mover& mover, Move previous) const {
  return rule_.provisional(mover.id, previous, world_.state.step,
                           [&](lattice::Direction to) { return lead_is_free(mover, to); });
}

void Stepper::decide(Lane& lane, const Lane& whose, std::uint32_t id) {
  Particle& particle = world_.state.particles[id];
  if (!particle.present || (!world_.state.pushes.empty() && world_.pushes.engaged(id))) {
    return;
  }
  Mover mover = this->mover(id, particle);
  if (whose.strip > 0 && dealt_elsewhere(whose, id, mover.site)) {
    return;
  }
  ++lane.looked_at;
  if (mover.footprint->one_window && mover.access != Access::seam) {
    mover.move =
        rule_.provisional(id, particle.previous, world_.state.step, [&](lattice::Direction to) {
          return (mover.taken & mover.footprint->windows[index_of(to)].lead) == 0;
        });
  } else {  // a copy is looked at there, so that this one can stay in registers
    mover.move = provisional_by_parts(Mover(mover), particle.previous);
  }
  if (mover.move == kRest) {
    particle.previous = kRest;
    return;
  }
  const bool falls = mover.move == static_cast<Move>(world_.state.rules.gravity);
  if (in_parallel_) {
    lane.load.note(mover.site, falls ? 1 : kSlopingLoad);
  }
  Movers& movers = lane.movers[mover.strip];
  copy_by_fields(mover, (falls ? movers.falling : movers.sloping).add());
}

}  // namespace clca::automaton
