#include "automaton/stepper.hpp"

#include <algorithm>
#include <span>

#include "automaton/retreat.hpp"

namespace clca::automaton {

namespace {

bool all_free(const lattice::Lattice& lattice, const Occupancy& occupancy, std::size_t place,
              int column, std::span<const lattice::Offset> offsets) {
  return std::none_of(offsets.begin(), offsets.end(), [&](lattice::Offset offset) {
    return occupancy.taken(lattice.at(place, column, offset));
  });
}

template <class Visit>
void for_each_lead_site(const lattice::Lattice& lattice, const Mover& mover, Visit visit) {
  for (const lattice::Offset offset : mover.footprint->lead[mover.move]) {
    visit(lattice.at(mover.place, mover.column, offset));
  }
}

}  // namespace

Stepper::Stepper(World& world, const Options& options)
    : world_(world),
      options_(options),
      rule_(world.state.rules, world.state.seed),
      order_(world.state.rules, world.state.seed),
      passive_(world),
      claims_(world.state.lattice.memory_size()) {}

std::size_t Stepper::advance() {
  if (!options_.sleeping) {
    for (std::uint32_t id = 0; id < world_.state.particles.size(); ++id) {
      world_.awake.insert(id);
    }
  }
  world_.awake.drain(looked_at_);
  if (parallel()) {
    carry_out<true>();
  } else {
    carry_out<false>();
  }
  const std::size_t uncontested = falling_.size() + sloping_.size() - turns_.size();
  const std::size_t moved = pushed_.size() + uncontested + move_contested();
  still_ = moved == 0 && quiet_;
  world_.changed = false;
  return moved;
}

template <bool kShared, class Visit>
void Stepper::for_each(std::size_t count, Visit visit) const {
  if constexpr (kShared) {
#pragma omp parallel for schedule(static) num_threads(options_.threads)
    for (std::size_t i = 0; i < count; ++i) {
      visit(i);
    }
  } else {
    for (std::size_t i = 0; i < count; ++i) {
      visit(i);
    }
  }
}

template <bool kShared>
void Stepper::carry_out() {
  pushed_.clear();
  quiet_ = true;
  const bool overlaps = !world_.state.pushes.empty();
  // Where nothing has moved or changed since all that overlap had last looked, they rest again.
  const bool engaged_may_move = overlaps && (!still_ || world_.changed || !options_.sleeping);
  if (overlaps) {
    leave_out_engaged();
  }
  decide<kShared>();
  collect_movers();
  if (engaged_may_move) {
    move_engaged();
  }
  find_contested<kShared>();
  turns_.clear();
  move_uncontested<kShared>(falling_);
  move_uncontested<kShared>(sloping_);
}

template <bool kShared>
void Stepper::decide() {
  wishes_.resize(looked_at_.size());
  State& state = world_.state;
  const Occupancy& occupancy = world_.occupancy;
  const lattice::Lattice& lattice = state.lattice;
  for_each<kShared>(looked_at_.size(), [&](std::size_t i) {
    const std::uint32_t id = looked_at_[i];
    Particle& particle = state.particles[id];
    if (!particle.present) {
      wishes_[i] = kRest;
      return;
    }
    const Footprint& footprint = world_.footprints.of(particle);
    const std::size_t place = lattice.index(particle.site());
    const int column = lattice.wrapped(particle.column);
    const auto is_free = [&](lattice::Direction direction) {
      return all_free(lattice, occupancy, place, column, footprint.lead[index_of(direction)]);
    };
    wishes_[i] = rule_.provisional(id, particle.previous, state.step, is_free);
    if (wishes_[i] == kRest) {
      particle.previous = kRest;
    }
  });
}

Mover Stepper::mover(std::uint32_t id, Move move) const {
  const Particle& particle = world_.state.particles[id];
  return {.place = world_.state.lattice.index(particle.site()),
          .column = world_.state.lattice.wrapped(particle.column),
          .id = id,
          .move = move,
          .contested = false,
          .engaged = false,
          .footprint = &world_.footprints.of(particle)};
}

void Stepper::collect_movers() {
  const Move gravity = static_cast<Move>(world_.state.rules.gravity);
  falling_.clear();
  sloping_.clear();
  for (std::size_t i = 0; i < looked_at_.size(); ++i) {
    if (wishes_[i] != kRest) {
      (wishes_[i] == gravity ? falling_ : sloping_).push_back(mover(looked_at_[i], wishes_[i]));
    }
  }
}

// Movers in one direction never want the same site, so those along gravity, mostly the many, need
// no claims of their own: they only look for those of the others.
template <bool kShared>
void Stepper::find_contested() {
  const lattice::Lattice& lattice = world_.state.lattice;
  if (sloping_.empty()) {
    return;
  }
  for_each<kShared>(sloping_.size(), [&](std::size_t i) {
    for_each_lead_site(lattice, sloping_[i], [&](std::size_t site) { claims_.add<kShared>(site); });
  });
  for_each<kShared>(falling_.size(), [&](std::size_t i) {
    for_each_lead_site(lattice, falling_[i], [&](std::size_t site) {
      if (claims_.wanted(site)) {
        claims_.contest<kShared>(site);
        falling_[i].contested = true;
      }
    });
  });
  for_each<kShared>(sloping_.size(), [&](std::size_t i) {
    for_each_lead_site(lattice, sloping_[i], [&](std::size_t site) {
      sloping_[i].contested = sloping_[i].contested || claims_.contested(site);
    });
  });
  for_each<kShared>(sloping_.size(), [&](std::size_t i) {
    for_each_lead_site(lattice, sloping_[i],
                       [&](std::size_t site) { claims_.clear<kShared>(site); });
  });
}

// A provisional target was free when the step began and what others vacate is nobody's target, so
// a mover whose lead sites nobody else wants moves whatever its place in the order.
template <bool kShared>
void Stepper::move_uncontested(const std::vector<Mover>& movers) {
  for_each<kShared>(movers.size(), [&](std::size_t i) {
    if (!movers[i].contested) {
      carry<kShared>(movers[i]);
    }
  });
  for (const Mover& mover : movers) {
    if (mover.contested) {
      turns_.push_back({key(mover.id, mover.move), &mover});
    }
  }
}

std::size_t Stepper::move_contested() {
  std::sort(turns_.begin(), turns_.end(),
            [](const Turn& left, const Turn& right) { return left.key < right.key; });
  std::size_t moved = 0;
  for (const auto& [key, mover] : turns_) {
    const auto direction = static_cast<lattice::Direction>(mover->move);
    if (mover->engaged && is_free(world_, mover->id, direction)) {
      world_.shift(mover->id, direction);
      ++moved;
    } else if (!mover->engaged && all_free(world_.state.lattice, world_.occupancy, mover->place,
                                           mover->column, mover->footprint->lead[mover->move])) {
      carry<false>(*mover);
      ++moved;
    } else {
      rest(mover->id);
    }
  }
  return moved;
}

void Stepper::rest(std::uint32_t id) {
  world_.state.particles[id].previous = kRest;
  world_.awake.insert(id);
}

// Waking needs only the owners that stay where they are: movers are awake anyway. So it does not
// matter which of the other moves of this step have been carried out already.
template <bool kShared>
void Stepper::carry(const Mover& mover) {
  const lattice::Lattice& lattice = world_.state.lattice;
  Occupancy& occupancy = world_.occupancy;
  const auto each = [&](const std::vector<lattice::Offset>& offsets, auto visit) {
    for (const lattice::Offset offset : offsets) {
      visit(lattice.at(mover.place, mover.column, offset));
    }
  };
  const auto wake_one = [&](std::uint32_t id) {
    if constexpr (kShared) {
      world_.awake.insert_shared(id);
    } else {
      world_.awake.insert(id);
    }
  };
  each(mover.footprint->lead[mover.move], [&](std::size_t site) {
    if constexpr (kShared) {
      occupancy.take_shared(site, static_cast<Owner>(mover.id));
    } else {
      occupancy.take(site, static_cast<Owner>(mover.id));
    }
  });
  each(mover.footprint->trail[mover.move], [&](std::size_t site) {
    if constexpr (kShared) {
      occupancy.release_shared(site);
    } else {
      occupancy.release(site);
    }
  });
  wake_one(mover.id);
  each(mover.footprint->wake[mover.move], [&](std::size_t site) {
    const Owner owner = kShared ? occupancy.owner_shared(site) : occupancy.owner(site);
    if (is_particle(owner)) {
      wake_one(static_cast<std::uint32_t>(owner));
    }
  });
  Particle& particle = world_.state.particles[mover.id];
  particle = moved(particle, static_cast<lattice::Direction>(mover.move));
  particle.previous = mover.move;
}

}  // namespace clca::automaton
