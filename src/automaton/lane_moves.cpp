// How movers find out who wants the same site, and moves, as one thread does them for its strip.

#include <algorithm>
#include <bit>

#include "automaton/stepper.hpp"

namespace clca::automaton {

namespace {

std::uint16_t count(std::uint64_t sites) {
  return sites == 0 ? 0 : static_cast<std::uint16_t>(std::popcount(sites));
}

std::size_t plus(std::size_t place, std::ptrdiff_t offset) {
  return place + static_cast<std::size_t>(offset);
}

std::size_t place_of(const lattice::Lattice& lattice, const Mover& mover, lattice::Offset offset) {
  return lattice.at(lattice.index(mover.site), mover.site.column, offset);
}

/// Calls `window` for the windows of the lead sites or, at a seam, `single` for each site.
template <class Window, class Single>
void for_each_lead(const World& world, const Mover& mover, Window window, Single single) {
  const Footprint& footprint = *mover.footprint;
  if (mover.access == Access::seam) {
    for (const lattice::Offset offset : footprint.lead[mover.move]) {
      single(place_of(world.state.lattice, mover, offset));
    }
  } else if (footprint.one_window) {
    window(mover.at, footprint.windows[mover.move].lead);
  } else {
    for (const Patch& lead : footprint.lead_patches[mover.move]) {
      window(world.occupancy.corner(lead.corner(mover.site)), lead.sites);
    }
  }
}

void wake(const World& world, Lane& lane, std::size_t place) {
  const Owner owner = world.occupancy.owner_shared(place);
  if (is_particle(owner)) {
    lane.awake.insert(static_cast<std::uint32_t>(owner));
  }
}

void wake_in_window(const World& world, Lane& lane, const Mover& mover, std::size_t place) {
  const std::ptrdiff_t stride = world.state.lattice.stride();
  const std::size_t corner = plus(place, mover.footprint->corner_place);
  std::uint64_t sites = mover.taken & mover.footprint->windows[mover.move].wake;
  for (; sites != 0; sites &= sites - 1) {
    const int bit = std::countr_zero(sites);
    wake(world, lane, plus(corner, bit % kWindow * stride + bit / kWindow));
  }
}

void wake_by_sites(const World& world, Lane& lane, const Mover& mover) {
  for (const lattice::Offset offset : mover.footprint->wake[mover.move]) {
    wake(world, lane, place_of(world.state.lattice, mover, offset));
  }
}

[[gnu::always_inline]] inline void flip(Occupancy& occupancy, const Mover& mover,
                                        SiteBits::Corner at, std::uint64_t sites) {
  mover.access == Access::alone ? occupancy.flip(at, sites) : occupancy.flip_shared(at, sites);
}

void carry_inside(World& world, Lane& lane, const Mover& mover) {
  const Footprint& footprint = *mover.footprint;
  const std::size_t place = world.state.lattice.index(mover.site);
  Occupancy& occupancy = world.occupancy;
  if (footprint.one_window) {
    flip(occupancy, mover, mover.at, footprint.windows[mover.move].swapped);
    wake_in_window(world, lane, mover, place);
  } else {
    wake_by_sites(world, lane, mover);
    for (const Patch& swapped : footprint.swapped_patches[mover.move]) {
      flip(occupancy, mover, occupancy.corner(swapped.corner(mover.site)), swapped.sites);
    }
  }
  occupancy.exchange_owners_shared(place, footprint.exchanges[mover.move],
                                   static_cast<Owner>(mover.id));
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

// Movers in one direction never want the same site, so those along gravity, mostly the many, need
// no claims of their own: they only look for those of the others.
void Stepper::claim(Lane& lane) {
  lane.claimed = {};
  for_each_mover(lane, &Movers::sloping, [&](const Mover& mover) {
    lane.claimed.include(mover.site.row);
    for_each_lead(
        world_, mover,
        [&](SiteBits::Corner at, std::uint64_t sites) {
          mover.access == Access::alone ? claims_.add(at, sites) : claims_.add_shared(at, sites);
        },
        [&](std::size_t place) { claims_.add_shared(place); });
  });
}

void Stepper::contest_falling(Lane& lane) {
  Rows claimed;
  for (const Lane& each : busy()) {
    claimed.include(each.claimed);
  }
  claimed = claimed.widened(2 * tallest_);
  for_each_mover(lane, &Movers::falling, [&](Mover& mover) {
    if (!claimed.contains(mover.site.row)) {
      return;
    }
    for_each_lead(
        world_, mover,
        [&](SiteBits::Corner at, std::uint64_t sites) {
          if (const std::uint64_t both = claims_.wanted(at) & sites; both != 0) {
            mover.contested += count(both);
            mover.access == Access::alone ? claims_.contest(at, both)
                                          : claims_.contest_shared(at, both);
          }
        },
        [&](std::size_t place) {
          if (claims_.wanted(place)) {
            ++mover.contested;
            claims_.contest_shared(place);
          }
        });
  });
}

// Afterwards nobody asks any more what is wanted.
void Stepper::contest_sloping(Lane& lane) {
  for_each_mover(lane, &Movers::sloping, [&](Mover& mover) {
    mover.contested = contested_lead(mover);
    for_each_lead(
        world_, mover,
        [&](SiteBits::Corner at, std::uint64_t) {
          mover.access == Access::alone ? claims_.forget(at) : claims_.forget_shared(at);
        },
        [&](std::size_t place) { claims_.forget_shared(place); });
  });
}

std::uint16_t Stepper::contested_lead(const Mover& mover) const {
  std::uint16_t result = 0;
  for_each_lead(
      world_, mover,
      [&](SiteBits::Corner at, std::uint64_t sites) {
        result = static_cast<std::uint16_t>(result + count(claims_.contested(at) & sites));
      },
      [&](std::size_t place) {
        result = static_cast<std::uint16_t>(result + (claims_.contested(place) ? 1 : 0));
      });
  return result;
}

// A provisional target was free when the step began and what others vacate is nobody's target, so
// a mover whose lead sites nobody else wants moves whatever its place in the order.
void Stepper::move_uncontested(Lane& lane) {
  for (Bag<Mover> Movers::*list : {&Movers::falling, &Movers::sloping}) {
    for_each_mover(lane, list, [&](Mover& mover) {
      if (mover.contested > 0 || mover.engaged) {
        lane.turns.push_back({key(mover.id, mover.move), &mover});
      } else {
        carry(lane, mover);
      }
    });
  }
  std::sort(lane.turns.begin(), lane.turns.end());
}

// In their order: who still finds all that it contests wins it.
void Stepper::choose_winners() {
  merge_turns();
  for (const auto& [key, mover] : turns_) {
    if (contested_lead(*mover) < mover->contested) {
      continue;
    }
    mover->won = true;
    ++contested_moved_;
    for_each_lead(
        world_, *mover, [&](SiteBits::Corner at, std::uint64_t sites) { claims_.win(at, sites); },
        [&](std::size_t place) { claims_.win(place); });
  }
}

void Stepper::move_winners(Lane& lane) {
  for (const auto& [key, mover] : lane.turns) {
    if (mover->won) {
      carry(lane, *mover);
    } else {
      rest(lane, mover->id);
    }
  }
}

void Stepper::end_contests(const Lane& lane) {
  for (const auto& [key, mover] : lane.turns) {
    const Access access = mover->access;
    for_each_lead(
        world_, *mover,
        [&](SiteBits::Corner at, std::uint64_t) {
          access == Access::alone ? claims_.end_contest(at) : claims_.end_contest_shared(at);
        },
        [&](std::size_t place) { claims_.end_contest_shared(place); });
  }
}

// Waking needs only the owners that stay where they are: movers are awake anyway. So it does not
// matter which of the other moves of this step have been carried out already; and as no site that
// was taken when the step began gets another owner in it, nobody reads a wrong one.
void Stepper::carry(Lane& lane, const Mover& mover) {
  lane.awake.insert(mover.id);
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
