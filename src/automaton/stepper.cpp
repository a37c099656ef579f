#include "stepper.hpp"

#include <algorithm>

namespace clca::automaton {

namespace {

bool all_free(const lattice::Lattice& lattice, const Occupancy& occupancy, std::size_t place,
              int column, std::span<const lattice::Offset> offsets) {
  return std::none_of(offsets.begin(), offsets.end(), [&](lattice::Offset offset) {
    return occupancy.taken(lattice.at(place, column, offset));
  });
}

/// Moves one particle, its lead sites being free.
template <bool kShared>
void carry(const lattice::Lattice& lattice, const Mover& mover, Particle& particle,
           Occupancy& occupancy) {
  for (const lattice::Offset offset : mover.footprint->lead[mover.move]) {
    const std::size_t site = lattice.at(mover.place, mover.column, offset);
    if constexpr (kShared) {
      occupancy.take_shared(site, static_cast<Owner>(mover.id));
    } else {
      occupancy.take(site, static_cast<Owner>(mover.id));
    }
  }
  for (const lattice::Offset offset : mover.footprint->trail[mover.move]) {
    const std::size_t site = lattice.at(mover.place, mover.column, offset);
    if constexpr (kShared) {
      occupancy.release_shared(site);
    } else {
      occupancy.release(site);
    }
  }
  const lattice::Site target =
      particle.site() + lattice::unit(static_cast<lattice::Direction>(mover.move));
  particle.column = target.column;
  particle.row = target.row;
  particle.previous = mover.move;
}

}  // namespace

Stepper::Stepper(const State& state, const Options& options)
    : options_(options),
      rule_(state.rules, state.seed),
      order_(state.rules, state.seed),
      footprints_(state),
      claims_(state.lattice.memory_size()) {}

void Stepper::advance(State& state, Occupancy& occupancy) {
  if (!options_.sleeping) {
    for (std::uint32_t id = 0; id < state.particles.size(); ++id) {
      awake_.insert(id);
    }
  }
  awake_.drain(looked_at_);
  decide(state, occupancy);
  collect_movers(state);
  if (parallel()) {
    carry_out<true>(state, occupancy);
  } else {
    carry_out<false>(state, occupancy);
  }
}

void Stepper::decide(State& state, const Occupancy& occupancy) {
  wishes_.resize(looked_at_.size());
  const lattice::Lattice& lattice = state.lattice;
#pragma omp parallel for schedule(static) num_threads(options_.threads) if (parallel())
  for (std::size_t i = 0; i < looked_at_.size(); ++i) {
    const std::uint32_t id = looked_at_[i];
    Particle& particle = state.particles[id];
    wishes_[i] = kRest;
    if (!particle.present) {
      continue;
    }
    const Footprint& footprint = footprints_.of(particle);
    const std::size_t place = lattice.index(particle.site());
    const int column = lattice.wrapped(particle.column);
    wishes_[i] = rule_.provisional(
        id, particle.previous, state.step, [&](lattice::Direction direction) {
          return all_free(lattice, occupancy, place, column, footprint.lead[index_of(direction)]);
        });
    if (wishes_[i] == kRest) {
      particle.previous = kRest;
    }
  }
}

void Stepper::collect_movers(const State& state) {
  movers_.clear();
  for (std::size_t i = 0; i < looked_at_.size(); ++i) {
    if (wishes_[i] == kRest) {
      continue;
    }
    const Particle& particle = state.particles[looked_at_[i]];
    movers_.push_back({.place = state.lattice.index(particle.site()),
                       .column = state.lattice.wrapped(particle.column),
                       .id = looked_at_[i],
                       .move = wishes_[i],
                       .contested = false,
                       .footprint = &footprints_.of(particle)});
  }
}

template <bool kShared>
void Stepper::carry_out(State& state, Occupancy& occupancy) {
  claim<kShared>(state.lattice);
  move_uncontested<kShared>(state, occupancy);
  move_contested(state, occupancy);
  wake_behind<kShared>(state.lattice, occupancy);
}

template <bool kShared>
void Stepper::claim(const lattice::Lattice& lattice) {
  const auto each_lead_site = [&](const Mover& mover, auto visit) {
    for (const lattice::Offset offset : mover.footprint->lead[mover.move]) {
      visit(lattice.at(mover.place, mover.column, offset));
    }
  };
#pragma omp parallel for schedule(static) num_threads(options_.threads) if (kShared)
  for (std::size_t i = 0; i < movers_.size(); ++i) {
    each_lead_site(movers_[i], [&](std::size_t site) { claims_.add<kShared>(site); });
  }
#pragma omp parallel for schedule(static) num_threads(options_.threads) if (kShared)
  for (std::size_t i = 0; i < movers_.size(); ++i) {
    each_lead_site(movers_[i], [&](std::size_t site) {
      movers_[i].contested = movers_[i].contested || claims_.contested(site);
    });
  }
#pragma omp parallel for schedule(static) num_threads(options_.threads) if (kShared)
  for (std::size_t i = 0; i < movers_.size(); ++i) {
    each_lead_site(movers_[i], [&](std::size_t site) { claims_.clear<kShared>(site); });
  }
}

// A provisional target was free when the step began and what others vacate is nobody's target, so
// a mover whose lead sites nobody else wants moves whatever its place in the order.
template <bool kShared>
void Stepper::move_uncontested(State& state, Occupancy& occupancy) {
#pragma omp parallel for schedule(static) num_threads(options_.threads) if (kShared)
  for (std::size_t i = 0; i < movers_.size(); ++i) {
    if (!movers_[i].contested) {
      carry<kShared>(state.lattice, movers_[i], state.particles[movers_[i].id], occupancy);
    }
  }
  moved_.clear();
  turns_.clear();
  for (const Mover& mover : movers_) {
    if (mover.contested) {
      const Move previous = state.particles[mover.id].previous;
      turns_.push_back({order_.key(mover.id, previous, mover.move, state.step), mover});
    } else {
      moved_.push_back(mover);
    }
  }
}

void Stepper::move_contested(State& state, Occupancy& occupancy) {
  std::sort(turns_.begin(), turns_.end(),
            [](const Turn& left, const Turn& right) { return left.key < right.key; });
  for (const auto& [key, mover] : turns_) {
    Particle& particle = state.particles[mover.id];
    if (all_free(state.lattice, occupancy, mover.place, mover.column,
                 mover.footprint->lead[mover.move])) {
      carry<false>(state.lattice, mover, particle, occupancy);
      moved_.push_back(mover);
    } else {
      particle.previous = kRest;
      awake_.insert(mover.id);
    }
  }
}

template <bool kShared>
void Stepper::wake_behind(const lattice::Lattice& lattice, const Occupancy& occupancy) {
  const auto wake_one = [&](std::uint32_t id) {
    if constexpr (kShared) {
      awake_.insert_shared(id);
    } else {
      awake_.insert(id);
    }
  };
#pragma omp parallel for schedule(static) num_threads(options_.threads) if (kShared)
  for (std::size_t i = 0; i < moved_.size(); ++i) {
    const Mover& mover = moved_[i];
    wake_one(mover.id);
    for (const lattice::Offset offset : mover.footprint->wake[mover.move]) {
      const Owner owner = occupancy.owner(lattice.at(mover.place, mover.column, offset));
      if (is_particle(owner)) {
        wake_one(static_cast<std::uint32_t>(owner));
      }
    }
  }
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
