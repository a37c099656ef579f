#include "automaton/stepper.hpp"

#include <algorithm>
#include <span>

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

Stepper::Stepper(const State& state, const Options& options)
    : options_(options),
      rule_(state.rules, state.seed),
      order_(state.rules, state.seed),
      footprints_(state),
      claims_(state.lattice.memory_size()) {}

std::size_t Stepper::advance(State& state, Occupancy& occupancy) {
  if (!options_.sleeping) {
    for (std::uint32_t id = 0; id < state.particles.size(); ++id) {
      awake_.insert(id);
    }
  }
  awake_.drain(looked_at_);
  if (parallel()) {
    carry_out<true>(state, occupancy);
  } else {
    carry_out<false>(state, occupancy);
  }
  const std::size_t uncontested = falling_.size() + sloping_.size() - turns_.size();
  return uncontested + move_contested(state, occupancy);
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
void Stepper::carry_out(State& state, Occupancy& occupancy) {
  decide<kShared>(state, occupancy);
  collect_movers(state);
  find_contested<kShared>(state.lattice);
  turns_.clear();
  move_uncontested<kShared>(falling_, state, occupancy);
  move_uncontested<kShared>(sloping_, state, occupancy);
}

template <bool kShared>
void Stepper::decide(State& state, const Occupancy& occupancy) {
  wishes_.resize(looked_at_.size());
  const lattice::Lattice& lattice = state.lattice;
  for_each<kShared>(looked_at_.size(), [&](std::size_t i) {
    const std::uint32_t id = looked_at_[i];
    Particle& particle = state.particles[id];
    if (!particle.present) {
      wishes_[i] = kRest;
      return;
    }
    const Footprint& footprint = footprints_.of(particle);
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

void Stepper::collect_movers(const State& state) {
  const Move gravity = static_cast<Move>(state.rules.gravity);
  falling_.clear();
  sloping_.clear();
  for (std::size_t i = 0; i < looked_at_.size(); ++i) {
    if (wishes_[i] == kRest) {
      continue;
    }
    const Particle& particle = state.particles[looked_at_[i]];
    std::vector<Mover>& movers = wishes_[i] == gravity ? falling_ : sloping_;
    movers.push_back({.place = state.lattice.index(particle.site()),
                      .column = state.lattice.wrapped(particle.column),
                      .id = looked_at_[i],
                      .move = wishes_[i],
                      .contested = false,
                      .footprint = &footprints_.of(particle)});
  }
}

// Movers in one direction never want the same site, so those along gravity, mostly the many, need
// no claims of their own: they only look for those of the others.
template <bool kShared>
void Stepper::find_contested(const lattice::Lattice& lattice) {
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
void Stepper::move_uncontested(const std::vector<Mover>& movers, State& state,
                               Occupancy& occupancy) {
  for_each<kShared>(movers.size(), [&](std::size_t i) {
    if (!movers[i].contested) {
      carry<kShared>(movers[i], state, occupancy);
    }
  });
  for (const Mover& mover : movers) {
    if (mover.contested) {
      const Move previous = state.particles[mover.id].previous;
      turns_.push_back({order_.key(mover.id, previous, mover.move, state.step), &mover});
    }
  }
}

std::size_t Stepper::move_contested(State& state, Occupancy& occupancy) {
  std::sort(turns_.begin(), turns_.end(),
            [](const Turn& left, const Turn& right) { return left.key < right.key; });
  std::size_t moved = 0;
  for (const auto& [key, mover] : turns_) {
    if (all_free(state.lattice, occupancy, mover->place, mover->column,
                 mover->footprint->lead[mover->move])) {
      carry<false>(*mover, state, occupancy);
      ++moved;
    } else {
      state.particles[mover->id].previous = kRest;
      awake_.insert(mover->id);
    }
  }
  return moved;
}

// Waking needs only the owners that stay where they are: movers are awake anyway. So it does not
// matter which of the other moves of this step have been carried out already.
template <bool kShared>
void Stepper::carry(const Mover& mover, State& state, Occupancy& occupancy) {
  const lattice::Lattice& lattice = state.lattice;
  const auto each = [&](const std::vector<lattice::Offset>& offsets, auto visit) {
    for (const lattice::Offset offset : offsets) {
      visit(lattice.at(mover.place, mover.column, offset));
    }
  };
  const auto wake_one = [&](std::uint32_t id) {
    if constexpr (kShared) {
      awake_.insert_shared(id);
    } else {
      awake_.insert(id);
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
  Particle& particle = state.particles[mover.id];
  const auto target = particle.site() + unit(static_cast<lattice::Direction>(mover.move));
  particle.column = target.column;
  particle.row = target.row;
  particle.previous = mover.move;
}

void Stepper::wake_around(const State& state, const Occupancy& occupancy,
                          const Particle& particle) {
  const std::size_t place = state.lattice.index(particle.site());
  const int column = state.lattice.wrapped(particle.column);
  for (const lattice::Offset offset : footprints_.of(particle).around) {
    const Owner owner = occupancy.owner(state.lattice.at(place, column, offset));
    if (is_particle(owner)) {
      awake_.insert(static_cast<std::uint32_t>(owner));
    }
  }
}

}  // namespace clca::automaton
