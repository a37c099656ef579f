// The part of a step that concerns particles which overlap: those pushed move first.

#include <algorithm>

#include "automaton/retreat.hpp"
#include "automaton/stepper.hpp"

namespace clca::automaton {

// All decide from the state at the start of the step; then the pushed have their turn, and what
// the others wanted is looked at again in the light of that.
void Stepper::move_engaged(Lane& lane) {
  decide_engaged();
  move_pushed();
  Movers& movers = lane.movers.front();
  yield_to_pushed(movers.falling);
  yield_to_pushed(movers.sloping);
  for (Mover& mover : freed_) {
    mover.standing = Standing::engaged;
    movers.sloping.add(mover);
    lane.waking.insert(mover.id);
  }
}

Mover Stepper::engaged_mover(std::uint32_t id) const {
  const grains::Particle& particle = world_.state.particles[id];
  Mover mover = {.site = site_of(particle),
                 .id = id,
                 .kind = particle.kind,
                 .previous = particle.previous,
                 .access = access(site_of(particle), 0),
                 .standing = Standing::engaged};
  const grains::Footprint& footprint = world_.footprints.of(particle);
  if (footprint.one_window && mover.access != Access::seam) {
    const grains::SiteBits::Corner at = world_.occupancy.corner(footprint.corner_from(mover.site));
    mover.byte = static_cast<std::uint32_t>(at.byte);
    mover.taken = world_.occupancy.window(at);
  }
  return mover;
}

void Stepper::decide_engaged() {
  pushed_.clear();
  freed_.clear();
  grains::State& state = world_.state;
  for (const std::uint32_t id : PushBook::engaged_particles(state)) {
    grains::Particle& particle = state.particles[id];
    quiet_ = quiet_ && particle.previous == grains::kRest;
    Mover mover = engaged_mover(id);
    if (!PushBook::onto(state, id).empty()) {
      mover.move = passive_.provisional(id);
      pushed_.push_back(mover);
      continue;
    }
    const auto free = [&](lattice::Direction direction) { return is_free(world_, id, direction); };
    const auto back = retreat(world_, id);
    mover.move = back ? *back : rule_.provisional(id, particle.previous, state.step, free);
    freed_.push_back(mover);
  }
  for (std::vector<Mover>* movers : {&pushed_, &freed_}) {
    for (const Mover& mover : *movers) {
      if (mover.move == grains::kRest) {
        state.particles[mover.id].previous = grains::kRest;
      }
    }
    std::erase_if(*movers, [](const Mover& mover) { return mover.move == grains::kRest; });
  }
}

void Stepper::move_pushed() {
  std::vector<Turn> turns;
  for (Mover& mover : pushed_) {
    turns.push_back({key(mover), &mover});
  }
  sort(turns);
  std::vector<Mover> moved;
  for (const auto& [key, mover] : turns) {
    if (passive_.move(mover->id, static_cast<lattice::Direction>(mover->move))) {
      moved.push_back(*mover);
    } else {
      world_.state.particles[mover->id].previous = grains::kRest;
    }
  }
  pushed_ = std::move(moved);
}

// Who has been pushed onto meanwhile still has its turn, but overlaps now.
void Stepper::yield_to_pushed(Bag<Mover>& movers) {
  grains::State& state = world_.state;
  movers.erase_if([&](const Mover& mover) {
    const grains::Particle& particle = state.particles[mover.id];
    if (world_.pushes.engaged(mover.id)) {
      freed_.push_back(mover);
      return true;
    }
    if (!world_.is_free(particle, static_cast<lattice::Direction>(mover.move))) {
      state.particles[mover.id].previous = grains::kRest;
      return true;
    }
    return false;
  });
}

void Stepper::give_turns_in_place(Lane& lane) {
  sort(lane.turns);
  for (const auto& [key, mover] : lane.turns) {
    const auto direction = static_cast<lattice::Direction>(mover->move);
    const bool engaged = mover->standing == Standing::engaged;
    if (engaged ? is_free(world_, mover->id, direction) : lead_is_free(*mover, direction)) {
      mover->standing = Standing::won;
    }
    if (engaged && mover->standing == Standing::won) {
      world_.shift(mover->id, direction);
    } else {
      carry_or_rest(lane, *mover);
    }
  }
}

}  // namespace clca::automaton
