// The phases of a step as one thread does them for the particles of its strip.

#include <algorithm>
#include <bit>

#include "automaton/stepper.hpp"

namespace clca::automaton {

namespace {

/// Ids that are sorted by kind together.
constexpr std::size_t kBatch = 1024;

/// What a move costs beside a look.
constexpr std::uint32_t kMoveLoad = 3;

std::size_t plus(std::size_t place, std::ptrdiff_t offset) {
  return place + static_cast<std::size_t>(offset);
}

std::size_t place_of(const lattice::Lattice& lattice, const Mover& mover, lattice::Offset offset) {
  return lattice.at(lattice.index(mover.site), mover.site.column, offset);
}

/// Calls `window` for the windows of the lead sites or, at a seam, `single` for each site.
template <class Window, class Single>
void for_each_lead(const lattice::Lattice& lattice, const Mover& mover, Window window,
                   Single single) {
  if (mover.access == Access::seam) {
    for (const lattice::Offset offset : mover.footprint->lead[mover.move]) {
      single(place_of(lattice, mover, offset));
    }
  } else {
    for (const Patch& lead : mover.footprint->lead_patches[mover.move]) {
      window(lead.corner(mover.site), lead.sites);
    }
  }
}

bool lead_is_free(const World& world, const Mover& mover, lattice::Direction direction) {
  const std::size_t d = index_of(direction);
  if (mover.access == Access::seam) {
    const auto& lead = mover.footprint->lead[d];
    return std::none_of(lead.begin(), lead.end(), [&](lattice::Offset offset) {
      return world.occupancy.taken(place_of(world.state.lattice, mover, offset));
    });
  }
  const auto& lead = mover.footprint->lead_patches[d];
  if (mover.footprint->one_window) {
    return (mover.taken & lead.front().sites) == 0;
  }
  return std::none_of(lead.begin(), lead.end(), [&](const Patch& patch) {
    return (world.occupancy.window(patch.corner(mover.site)) & patch.sites) != 0;
  });
}

void wake_in_window(const World& world, const Lane& lane, const Mover& mover, std::size_t place) {
  const std::ptrdiff_t stride = world.occupancy.stride();
  const Footprint& footprint = *mover.footprint;
  const std::size_t corner = plus(place, footprint.corner.column * stride + footprint.corner.row);
  for (const Patch& wake : footprint.wake_patches[mover.move]) {  // one, or none
    for (std::uint64_t sites = mover.taken & wake.sites; sites != 0; sites &= sites - 1) {
      const int bit = std::countr_zero(sites);
      const Owner owner =
          world.occupancy.owner_shared(plus(corner, bit / kWindow * stride + bit % kWindow));
      if (is_particle(owner)) {
        lane.awake->insert(static_cast<std::uint32_t>(owner));
      }
    }
  }
}

void wake_by_sites(const World& world, const Lane& lane, const Mover& mover) {
  for (const lattice::Offset offset : mover.footprint->wake[mover.move]) {
    const Owner owner = world.occupancy.owner_shared(place_of(world.state.lattice, mover, offset));
    if (is_particle(owner)) {
      lane.awake->insert(static_cast<std::uint32_t>(owner));
    }
  }
}

void carry_inside(World& world, Lane& lane, const Mover& mover) {
  const Footprint& footprint = *mover.footprint;
  const std::size_t place = world.state.lattice.index(mover.site);
  Occupancy& occupancy = world.occupancy;
  if (!footprint.one_window) {
    wake_by_sites(world, lane, mover);
  }
  for (const Patch& swapped : footprint.swapped_patches[mover.move]) {
    mover.access == Access::alone
        ? occupancy.flip(swapped.corner(mover.site), swapped.sites)
        : occupancy.flip_shared(swapped.corner(mover.site), swapped.sites);
  }
  for (const lattice::Offset offset : footprint.lead[mover.move]) {
    occupancy.set_owner_shared(plus(place, offset.linear), static_cast<Owner>(mover.id));
  }
  for (const lattice::Offset offset : footprint.trail[mover.move]) {
    occupancy.set_owner_shared(plus(place, offset.linear), kFree);
  }
  if (footprint.one_window) {
    wake_in_window(world, lane, mover, place);
  }
}

void carry_across_seam(World& world, Lane& lane, const Mover& mover) {
  const lattice::Lattice& lattice = world.state.lattice;
  Occupancy& occupancy = world.occupancy;
  wake_by_sites(world, lane, mover);
  for (const lattice::Offset offset : mover.footprint->lead[mover.move]) {
    const std::size_t place = place_of(lattice, mover, offset);
    occupancy.set_owner_shared(place, static_cast<Owner>(mover.id));
    occupancy.set_taken_shared(place);
  }
  for (const lattice::Offset offset : mover.footprint->trail[mover.move]) {
    const std::size_t place = place_of(lattice, mover, offset);
    occupancy.set_owner_shared(place, kFree);
    occupancy.set_free_shared(place);
  }
}

}  // namespace

// Mostly those of its own strip.
void Stepper::find_awake(Lane& lane) {
  for (std::vector<std::uint32_t>& ids : lane.found) {
    ids.clear();
  }
  const State& state = world_.state;
  lane.awake->drain([&](std::uint32_t id) {
    const std::size_t strip =
        in_parallel_ ? strips_.of(state.lattice.wrapped(state.particles[id].column)) : 0;
    lane.found[strip].push_back(id);
  });
}

void Stepper::take_over(Lane& lane) {
  std::vector<std::uint32_t>& own = lane.found[lane.strip];
  std::vector<std::uint32_t>& more = lane.taken_over;
  more.clear();
  for (const Lane& other : lanes_) {
    if (&other != &lane) {
      more.insert(more.end(), other.found[lane.strip].begin(), other.found[lane.strip].end());
    }
  }
  std::sort(more.begin(), more.end());
  more.erase(std::unique(more.begin(), more.end()), more.end());
  std::erase_if(more, [&](std::uint32_t id) {
    return std::binary_search(own.begin(), own.end(), id);  // drained, so ascending
  });
  own.insert(own.end(), more.begin(), more.end());
}

// Kind after kind: what a processor guesses of the way through the lists of sites is right then.
void Stepper::look(Lane& lane, std::span<const std::uint32_t> ids) {
  lane.looked_at += ids.size();
  for (; !ids.empty(); ids = ids.subspan(std::min(kBatch, ids.size()))) {
    for (const std::uint32_t id : ids.first(std::min(kBatch, ids.size()))) {
      lane.of_kind[world_.state.particles[id].kind].push_back(id);
    }
    for (std::vector<std::uint32_t>& alike : lane.of_kind) {
      for (const std::uint32_t id : alike) {
        decide(lane, id);
      }
      alike.clear();
    }
  }
}

void Stepper::note(Lane& lane, int column, std::uint32_t load) const {
  if (in_parallel_) {
    Strips::note(lane.load, column, load);
  }
}

void Stepper::decide(Lane& lane, std::uint32_t id) {
  Particle& particle = world_.state.particles[id];
  if (!particle.present) {
    return;
  }
  Mover mover = this->mover(id, particle, lane.inner);
  note(lane, mover.site.column, 1);
  mover.move = rule_.provisional(
      id, particle.previous, world_.state.step,
      [&](lattice::Direction direction) { return lead_is_free(world_, mover, direction); });
  if (mover.move == kRest) {
    particle.previous = kRest;
    return;
  }
  note(lane, mover.site.column, kMoveLoad);
  const Move gravity = static_cast<Move>(world_.state.rules.gravity);
  (mover.move == gravity ? lane.falling : lane.sloping).push_back(mover);
}

// Movers in one direction never want the same site, so those along gravity, mostly the many, need
// no claims of their own: they only look for those of the others.
void Stepper::claim(Lane& lane) {
  lane.claimed = {};
  for (const Mover& mover : lane.sloping) {
    lane.claimed.include(mover.site.row);
    for_each_lead(
        world_.state.lattice, mover,
        [&](lattice::Site corner, std::uint64_t sites) {
          mover.access == Access::alone ? claims_.add(corner, sites)
                                        : claims_.add_shared(corner, sites);
        },
        [&](std::size_t place) { claims_.add_shared(place); });
  }
}

void Stepper::contest_falling(Lane& lane) {
  Rows claimed;
  for (const Lane& each : lanes_) {
    claimed.include(each.claimed);
  }
  claimed = claimed.widened(2 * tallest_);
  for (Mover& mover : lane.falling) {
    if (!claimed.contains(mover.site.row)) {
      continue;
    }
    for_each_lead(
        world_.state.lattice, mover,
        [&](lattice::Site corner, std::uint64_t sites) {
          if (const std::uint64_t both = claims_.wanted(corner) & sites; both != 0) {
            mover.contested = true;
            mover.access == Access::alone ? claims_.contest(corner, both)
                                          : claims_.contest_shared(corner, both);
          }
        },
        [&](std::size_t place) {
          if (claims_.wanted(place)) {
            mover.contested = true;
            claims_.contest_shared(place);
          }
        });
  }
}

void Stepper::contest_sloping(Lane& lane) {
  for (Mover& mover : lane.sloping) {
    for_each_lead(
        world_.state.lattice, mover,
        [&](lattice::Site corner, std::uint64_t sites) {
          mover.contested |= (claims_.contested(corner) & sites) != 0;
        },
        [&](std::size_t place) { mover.contested |= claims_.contested(place); });
  }
}

void Stepper::clear_claims(const Lane& lane) {
  for (const Mover& mover : lane.sloping) {
    for_each_lead(
        world_.state.lattice, mover,
        [&](lattice::Site corner, std::uint64_t sites) {
          if (mover.access != Access::alone) {
            claims_.clear_shared(corner, sites);
            return;
          }
          claims_.clear(corner, sites);
          if (mover.contested) {  // then it knows
            claims_.clear_contested(corner, sites);
          }
        },
        [&](std::size_t place) { claims_.clear_shared(place); });
  }
}

// A provisional target was free when the step began and what others vacate is nobody's target, so
// a mover whose lead sites nobody else wants moves whatever its place in the order.
void Stepper::move_uncontested(Lane& lane, const std::vector<Mover>& movers) {
  for (const Mover& mover : movers) {
    if (mover.contested) {
      lane.turns.push_back({key(mover.id, mover.move), &mover});
    } else {
      carry(lane, mover);
    }
  }
}

// Waking needs only the owners that stay where they are: movers are awake anyway. So it does not
// matter which of the other moves of this step have been carried out already; and as no site that
// was taken when the step began gets another owner in it, nobody reads a wrong one.
void Stepper::carry(Lane& lane, const Mover& mover) {
  lane.awake->insert(mover.id);
  if (mover.access == Access::seam) {
    carry_across_seam(world_, lane, mover);
  } else {
    carry_inside(world_, lane, mover);
  }
  Particle& particle = world_.state.particles[mover.id];
  const lattice::Site step = mover.footprint->step[mover.move];
  particle.column += step.column;
  particle.row += step.row;
  particle.previous = mover.move;
}

}  // namespace clca::automaton
