// How movers find out who wants the same site, and who gets it.

#include <bit>

#include "automaton/stepper.hpp"

namespace clca::automaton {

namespace {

std::uint16_t count(std::uint64_t sites) {
  return sites == 0 ? 0 : static_cast<std::uint16_t>(std::popcount(sites));
}

/// Calls `window` for the windows of the lead sites or, at a seam, `single` for each site.
template <class Window, class Single>
[[gnu::always_inline]] inline void for_each_lead(const World& world, const Mover& mover,
                                                 Window window, Single single) {
  const grains::Footprint& footprint = world.footprints.of(mover.kind, mover.site.column);
  if (mover.access == Access::seam) {
    const std::size_t place = world.state.lattice.index(mover.site);
    for (const lattice::Offset offset : footprint.lead[mover.move]) {
      single(world.state.lattice.at(place, mover.site.column, offset));
    }
  } else if (footprint.one_window) {
    window(corner(mover, footprint), footprint.windows[mover.move].lead);
  } else {
    for (const grains::Patch& lead : footprint.lead_patches[mover.move]) {
      window(world.occupancy.corner(lead.corner(mover.site)), lead.sites);
    }
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
        [&](grains::SiteBits::Corner at, std::uint64_t sites) {
          mover.access == Access::alone ? claims_.add(at, sites) : claims_.add_shared(at, sites);
        },
        [&](std::size_t place) { claims_.add_shared(place); });
  });
}

void Stepper::contest(Mover& mover) {
  for_each_lead(
      world_, mover,
      [&](grains::SiteBits::Corner at, std::uint64_t sites) {
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
}

void Stepper::contest_falling(Lane& lane) {
  Rows claimed;
  for (const Lane& each : busy()) {
    claimed.include(each.claimed);
  }
  claimed = claimed.widened(2 * tallest_);
  for_each_mover(lane, &Movers::falling, [&](Mover& mover) {
    if (claimed.contains(mover.site.row)) {
      contest(mover);
    }
  });
}

void Stepper::forget_claim(const Mover& mover) {
  for_each_lead(
      world_, mover,
      [&](grains::SiteBits::Corner at, std::uint64_t) {
        mover.access == Access::alone ? claims_.forget(at) : claims_.forget_shared(at);
      },
      [&](std::size_t place) { claims_.forget_shared(place); });
}

std::uint16_t Stepper::contested_lead(const Mover& mover) const {
  std::uint16_t result = 0;
  for_each_lead(
      world_, mover,
      [&](grains::SiteBits::Corner at, std::uint64_t sites) {
        result = static_cast<std::uint16_t>(result + count(claims_.contested(at) & sites));
      },
      [&](std::size_t place) {
        result = static_cast<std::uint16_t>(result + (claims_.contested(place) ? 1 : 0));
      });
  return result;
}

// In their order: who still finds all that it contests wins it.
void Stepper::give_turn(Mover& mover) {
  if (contested_lead(mover) == mover.contested) {
    mover.standing = Standing::won;
    for_each_lead(
        world_, mover,
        [&](grains::SiteBits::Corner at, std::uint64_t sites) { claims_.win(at, sites); },
        [&](std::size_t place) { claims_.win(place); });
  }
}

bool Stepper::is_open(const Mover& mover, bool any_open) const {
  bool open = mover.access != Access::alone;
  if (!any_open) {
    return open;
  }
  for_each_lead(
      world_, mover,
      [&](grains::SiteBits::Corner at, std::uint64_t sites) {
        open = open || claims_.open(at, sites);
      },
      [](std::size_t) {});
  return open;
}

void Stepper::leave_open(const Mover& mover) {
  for_each_lead(
      world_, mover,
      [&](grains::SiteBits::Corner at, std::uint64_t sites) {
        mover.access == Access::alone ? claims_.leave_open(at, sites)
                                      : claims_.leave_open_shared(at, sites);
      },
      [&](std::size_t place) { claims_.leave_open_shared(place); });
}

// Those far from other strips have their turn at once, unless somebody who is not, or depends on
// such a one, and is before them in the order, wants one of their sites.
void Stepper::give_own_turns(Lane& lane) {
  sort(lane.turns);
  for (const Turn& turn : lane.turns) {
    Mover& mover = *turn.mover;
    if (is_open(mover, !lane.open.empty())) {
      leave_open(mover);
      lane.open.push_back(turn);
    } else {
      give_turn(mover);
      carry_or_rest(lane, mover);
    }
  }
}

// All of them together.
void Stepper::give_open_turns() {
  open_.clear();
  for (const Lane& lane : lanes_) {
    merge(open_, lane.open);
  }
  for (const Turn& turn : open_) {
    give_turn(*turn.mover);
  }
}

void Stepper::end_contests(Lane& lane) {
  for (const auto& [key, mover] : lane.turns) {
    const Access access = mover->access;
    for_each_lead(
        world_, *mover,
        [&](grains::SiteBits::Corner at, std::uint64_t) {
          access == Access::alone ? claims_.end_contest(at) : claims_.end_contest_shared(at);
        },
        [&](std::size_t place) { claims_.end_contest_shared(place); });
  }
  for (const auto& [key, mover] : lane.open) {
    for_each_lead(
        world_, *mover,
        [&](grains::SiteBits::Corner at, std::uint64_t) { claims_.close_shared(at); },
        [&](std::size_t place) { claims_.close_shared(place); });
  }
  for (const auto& [key, mover] : lane.turns) {
    mover->move = mover->standing == Standing::won ? mover->move : grains::kRest;
  }
}

}  // namespace clca::automaton
