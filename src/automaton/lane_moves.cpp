// The phases of a step as one thread does them for the particles of its strip.

#include <algorithm>
#include <bit>

#include "automaton/stepper.hpp"

namespace clca::automaton {

namespace {

/// Ids that are sorted by kind together.
constexpr std::size_t kBatch = 1024;

std::size_t plus(std::size_t place, std::ptrdiff_t offset) {
  return place + static_cast<std::size_t>(offset);
}

std::size_t place_of(const lattice::Lattice& lattice, const Mover& mover, lattice::Offset offset) {
  return lattice.at(lattice.index(mover.site), mover.site.column, offset);
}

/// Calls `window` for the windows of the lead sites or, near a border, `single` for each site.
template <class Window, class Single>
void for_each_lead(const lattice::Lattice& lattice, const Mover& mover, Window window,
                   Single single) {
  if (mover.near_border) {
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
  if (mover.near_border) {
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

}  // namespace

void Stepper::find_awake(Lane& lane) {
  for (std::vector<std::uint32_t>& ids : lane.found) {
    ids.clear();
  }
  if (!in_parallel_) {
    AwakeSet::drain(awake_, 0, 1, [&](std::uint32_t id) { lane.found.front().push_back(id); });
    return;
  }
  const State& state = world_.state;
  AwakeSet::drain(awake_, lane.strip, lanes_.size(), [&](std::uint32_t id) {
    const int column = state.lattice.wrapped(state.particles[id].column);
    lane.found[strips_.of(column)].push_back(id);
  });
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

void Stepper::decide(Lane& lane, std::uint32_t id) {
  Particle& particle = world_.state.particles[id];
  if (!particle.present) {
    return;
  }
  Mover mover = this->mover(id, particle, lane.inner);
  mover.move = rule_.provisional(
      id, particle.previous, world_.state.step,
      [&](lattice::Direction direction) { return lead_is_free(world_, mover, direction); });
  if (mover.move == kRest) {
    particle.previous = kRest;
    return;
  }
  if (in_parallel_) {
    Strips::note(lane.load, mover.site.column);
  }
  const Move gravity = static_cast<Move>(world_.state.rules.gravity);
  (mover.move == gravity ? lane.falling : lane.sloping).push_back(mover);
}

// Movers in one direction never want the same site, so those along gravity, mostly the many, need
// no claims of their own: they only look for those of the others.
void Stepper::claim(const Lane& lane) {
  for (const Mover& mover : lane.sloping) {
    for_each_lead(
        world_.state.lattice, mover,
        [&](lattice::Site corner, std::uint64_t window) { claims_.add(corner, window); },
        [&](std::size_t place) { claims_.add_shared(place); });
  }
}

void Stepper::contest_falling(Lane& lane) {
  for (Mover& mover : lane.falling) {
    for_each_lead(
        world_.state.lattice, mover,
        [&](lattice::Site corner, std::uint64_t window) {
          mover.contested = claims_.contest(corner, window) || mover.contested;
        },
        [&](std::size_t place) {
          mover.contested = claims_.contest_shared(place) || mover.contested;
        });
  }
}

void Stepper::contest_sloping(Lane& lane) {
  for (Mover& mover : lane.sloping) {
    for_each_lead(
        world_.state.lattice, mover,
        [&](lattice::Site corner, std::uint64_t window) {
          mover.contested = mover.contested || claims_.contested(corner, window);
        },
        [&](std::size_t place) {
          mover.contested = mover.contested || claims_.contested_shared(place);
        });
  }
}

void Stepper::clear_claims(const Lane& lane) {
  for (const Mover& mover : lane.sloping) {
    for_each_lead(
        world_.state.lattice, mover,
        [&](lattice::Site corner, std::uint64_t window) {
          claims_.clear(corner, window, mover.contested);
        },
        [&](std::size_t place) { claims_.clear_shared(place); });
  }
}

// A provisional target was free when the step began and what others vacate is nobody's target, so
// a mover whose lead sites nobody else wants moves whatever its place in the order.
void Stepper::move_uncontested(Lane& lane, const std::vector<Mover>& movers) {
  for (std::size_t i = 0; i < movers.size(); ++i) {
    const Mover& mover = movers[i];
    if (mover.contested) {
      lane.turns.push_back({key(mover.id, mover.move), &mover});
    } else {
      carry(lane, mover);
    }
  }
}

// Waking needs only the owners that stay where they are: movers are awake anyway. So it does not
// matter which of the other moves of this step have been carried out already.
void Stepper::carry(Lane& lane, const Mover& mover) {
  lane.awake->insert(mover.id);
  if (mover.near_border) {
    carry_near_border(lane, mover);
  } else {
    carry_inside(lane, mover);
  }
  Particle& particle = world_.state.particles[mover.id];
  particle = moved(particle, static_cast<lattice::Direction>(mover.move));
  particle.previous = mover.move;
}

void Stepper::carry_inside(Lane& lane, const Mover& mover) {
  const Footprint& footprint = *mover.footprint;
  const std::size_t place = world_.state.lattice.index(mover.site);
  Occupancy& occupancy = world_.occupancy;
  for (const Patch& swapped : footprint.swapped_patches[mover.move]) {
    occupancy.flip(swapped.corner(mover.site), swapped.sites);
  }
  for (const lattice::Offset offset : footprint.lead[mover.move]) {
    occupancy.set_owner(plus(place, offset.linear), static_cast<Owner>(mover.id));
  }
  for (const Patch& wake : footprint.wake_patches[mover.move]) {
    // What has moved away since the step began is awake anyway.
    const std::uint64_t taken =
        footprint.one_window ? mover.taken : occupancy.window(wake.corner(mover.site));
    const std::ptrdiff_t stride = occupancy.stride();
    const std::size_t corner = plus(place, wake.column * stride + wake.row);
    for (std::uint64_t sites = taken & wake.sites; sites != 0; sites &= sites - 1) {
      const int bit = std::countr_zero(sites);
      const Owner owner =
          occupancy.owner_of_taken(plus(corner, bit / kWindow * stride + bit % kWindow));
      if (is_particle(owner)) {
        lane.awake->insert(static_cast<std::uint32_t>(owner));
      }
    }
  }
}

void Stepper::carry_near_border(Lane& lane, const Mover& mover) {
  const lattice::Lattice& lattice = world_.state.lattice;
  Occupancy& occupancy = world_.occupancy;
  for (const lattice::Offset offset : mover.footprint->lead[mover.move]) {
    occupancy.take_shared(place_of(lattice, mover, offset), static_cast<Owner>(mover.id));
  }
  for (const lattice::Offset offset : mover.footprint->trail[mover.move]) {
    occupancy.release_shared(place_of(lattice, mover, offset));
  }
  for (const lattice::Offset offset : mover.footprint->wake[mover.move]) {
    const Owner next = occupancy.owner_shared(place_of(lattice, mover, offset));
    if (is_particle(next)) {
      lane.awake->insert(static_cast<std::uint32_t>(next));
    }
  }
}

}  // namespace clca::automaton
