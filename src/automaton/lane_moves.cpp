// How moves are carried out, as one thread does it for its strip.

#include <bit>

#include "automaton/stepper.hpp"

namespace clca::automaton {

namespace {

/// So many windows in which somebody wakes are gone through at once, soon after they were changed.
constexpr std::size_t kWakeBatch = 64;

std::size_t place_of(const lattice::Lattice& lattice, const Mover& mover, lattice::Offset offset) {
  return lattice.at(lattice.index(mover.site), mover.site.column, offset);
}

void wake(const World& world, Lane& lane, std::size_t place) {
  const grains::Owner owner = world.occupancy.owner_shared(place);
  if (grains::is_particle(owner)) {
    lane.waking.insert(static_cast<std::uint32_t>(owner));
  }
}

void wake_in_window(Lane& lane, const Mover& mover, const grains::Footprint& footprint) {
  const std::uint64_t sites = mover.taken & footprint.windows[mover.move].wake;
  lane.to_wake.add_if(sites != 0, {footprint.corner_from(mover.site), sites});
}

void wake_by_sites(const World& world, Lane& lane, const Mover& mover,
                   const grains::Footprint& footprint) {
  for (const lattice::Offset offset : footprint.wake[mover.move]) {
    wake(world, lane, place_of(world.state.lattice, mover, offset));
  }
}

[[gnu::always_inline]] inline void flip(grains::Occupancy& occupancy, const Mover& mover,
                                        grains::SiteBits::Corner at, std::uint64_t sites) {
  mover.access == Access::alone ? occupancy.flip(at, sites) : occupancy.flip_shared(at, sites);
}

void carry_inside(World& world, Lane& lane, const Mover& mover,
                  const grains::Footprint& footprint) {
  grains::Occupancy& occupancy = world.occupancy;
  if (footprint.one_window) {
    flip(occupancy, mover, corner(mover, footprint), footprint.windows[mover.move].swapped);
    wake_in_window(lane, mover, footprint);
  } else {
    wake_by_sites(world, lane, mover, footprint);
    for (const grains::Patch& swapped : footprint.swapped_patches[mover.move]) {
      flip(occupancy, mover, occupancy.corner(swapped.corner(mover.site)), swapped.sites);
    }
  }
  const std::size_t place = world.state.lattice.index(mover.site);
  for (const grains::Exchanges& exchanges : footprint.exchanges[mover.move]) {
    occupancy.exchange_owners_shared(place, exchanges, static_cast<grains::Owner>(mover.id));
  }
}

void carry_across_seam(World& world, Lane& lane, const Mover& mover,
                       const grains::Footprint& footprint) {
  const lattice::Lattice& lattice = world.state.lattice;
  grains::Occupancy& occupancy = world.occupancy;
  wake_by_sites(world, lane, mover, footprint);
  for (const lattice::Offset offset : footprint.lead[mover.move]) {
    const std::size_t place = place_of(lattice, mover, offset);
    occupancy.set_owner_shared(place, static_cast<grains::Owner>(mover.id));
    occupancy.set_taken_shared(place);
  }
  for (const lattice::Offset offset : footprint.trail[mover.move]) {
    const std::size_t place = place_of(lattice, mover, offset);
    occupancy.set_owner_shared(place, grains::kFree);
    occupancy.set_free_shared(place);
  }
}

}  // namespace

void Stepper::mark_found_by_others(Lane& lane) {
  for (const Lane& finder : busy()) {
    if (&finder == &lane) {
      continue;
    }
    const Movers& movers = finder.movers[lane.strip];
    for (const Bag<Mover>* list : {&movers.falling, &movers.sloping}) {
      for (const Mover& mover : *list) {
        lane.waking.mark(mover.id);
      }
    }
  }
}

// A provisional target was free when the step began and what others vacate is nobody's target, so
// a mover whose lead sites nobody else wants moves whatever its place in the order.
void Stepper::move_unless_contested(Lane& lane, Mover& mover) {
  if (mover.contested > 0 || mover.standing == Standing::engaged) {
    lane.turns.push_back({key(mover), &mover});
  } else {
    carry(lane, mover);
  }
}

void Stepper::move(Lane& lane) {
  for_each_mover(lane, &Movers::falling, [&](Mover& mover) { move_unless_contested(lane, mover); });
  for_each_mover(lane, &Movers::sloping, [&](Mover& mover) {
    mover.contested = contested_lead(mover);
    forget_claim(mover);  // nobody asks any more what is wanted
    move_unless_contested(lane, mover);
  });
  wake_neighbours(lane);
}

void Stepper::carry_or_rest(Lane& lane, const Mover& mover) {
  if (mover.standing == Standing::won) {
    carry(lane, mover);
  } else {
    world_.state.particles[mover.id].previous = grains::kRest;
  }
}

void Stepper::end_turns(Lane& lane) {
  for (const Turn& turn : lane.open) {
    carry_or_rest(lane, *turn.mover);
  }
  wake_neighbours(lane);
  end_contests(lane);
}

// Waking needs only the owners that stay where they are: movers are awake anyway. So it does not
// matter which of the other moves of this step have been carried out already; and as no site that
// was taken when the step began gets another owner in it, nobody reads a wrong one.
void Stepper::carry(Lane& lane, const Mover& mover) {
  const grains::Footprint& footprint = world_.footprints.of(mover.kind, mover.site.column);
  if (mover.access == Access::seam) {
    carry_across_seam(world_, lane, mover, footprint);
  } else {
    carry_inside(world_, lane, mover, footprint);
  }
  grains::Particle& particle = world_.state.particles[mover.id];
  const lattice::Site step = step_of(mover.site, mover.move);
  if (world_.state.lattice.periodic()) {
    particle.column += step.column;
  } else {  // to write what is far away need not be waited for
    particle.column = mover.site.column + step.column;
  }
  particle.row = mover.site.row + step.row;
  particle.previous = mover.move;
  if (lane.to_wake.size() >= kWakeBatch) {
    wake_neighbours(lane);
  }
}

// One loop for all, as how many sites each has a processor cannot guess.
void Stepper::wake_neighbours(Lane& lane) {
  const lattice::Lattice& lattice = world_.state.lattice;
  lane.to_wake.add({});
  const Wake* from = lane.to_wake.begin();
  std::uint64_t sites = from->sites;
  while (sites != 0) {
    const int bit = std::countr_zero(sites);
    wake(world_, lane,
         lattice.index({from->corner.column + bit % grains::kWindow,
                        from->corner.row + bit / grains::kWindow}));
    sites &= sites - 1;
    const std::uint64_t none = sites == 0 ? 1 : 0;
    from += none;
    sites |= from->sites & (0 - none);
  }
  lane.to_wake.clear();
}

}  // namespace clca::automaton
