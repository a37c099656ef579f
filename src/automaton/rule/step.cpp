#include "automaton/rule/step.hpp"

#include "automaton/rule/retreat.hpp"
#include "grains/internal/outlet.hpp"

namespace clca::automaton {

grains::Move Decisions::provisional(std::uint32_t id) {
  // The passive rule, for those that something has been pushed onto.
  if (!PushList::onto(world_.state, id).empty()) {
    return passive_.provisional(id);
  }
  // Back from those that it has pushed itself, where they rest.
  if (const auto back = retreat(world_, id)) {
    return *back;
  }
  // Else the active rule.
  return active_.provisional(
      id, world_.state.particles[id].previous, world_.state.step,
      [&](lattice::Direction direction) { return is_free(world_, id, direction); });
}

bool Decisions::move(std::uint32_t id, lattice::Direction direction) {
  if (!is_free(world_, id, direction)) {
    return false;
  }
  world_.move(id, direction);
  return true;
}

std::size_t ReferenceStep::advance() {
  moved_.clear();
  // 3. Every particle chooses a provisional direction, from the state at this moment alone.
  choose_provisional_directions();
  // 4. Movers have their turn in an order of priority: first those that something has been pushed
  // onto, then the others.
  give_turns(pushed_, &Decisions::move_pushed);
  give_turns(others_, &Decisions::move);
  world_.changes.clear();
  return moved_.size();
}

void ReferenceStep::choose_provisional_directions() {
  grains::State& state = world_.state;
  pushed_.clear();
  others_.clear();
  examined_ = 0;
  quiet_ = true;
  std::vector<std::uint32_t> resting;  // known to others only when all have chosen
  for (std::uint32_t id = 0; id < state.particles.size(); ++id) {
    const grains::Particle& particle = state.particles[id];
    if (!particle.present) {
      continue;
    }
    ++examined_;
    quiet_ = quiet_ && !(world_.pushes.overlapping(id) && particle.previous != grains::kRest);
    const grains::Move move = decisions_.provisional(id);
    if (move == grains::kRest) {
      resting.push_back(id);
      continue;
    }
    std::vector<ProposedMove>& movers = PushList::onto(state, id).empty() ? others_ : pushed_;
    movers.push_back(
        {.key = decisions_.key(id, move), .direction = static_cast<lattice::Direction>(move)});
  }
  for (const std::uint32_t id : resting) {
    state.particles[id].previous = grains::kRest;
  }
}

void ReferenceStep::give_turns(std::vector<ProposedMove>& movers,
                               bool (Decisions::*move)(std::uint32_t, lattice::Direction)) {
  std::sort(movers.begin(), movers.end(),
            [](const ProposedMove& one, const ProposedMove& other) { return one.key < other.key; });
  for (const ProposedMove& mover : movers) {
    const std::uint32_t id = mover.key.id;
    if ((decisions_.*move)(id, mover.direction)) {
      moved_.push_back(id);
    } else {
      // Who finds the way taken rests.
      world_.state.particles[id].previous = grains::kRest;
    }
  }
}

bool remove_at_outlet(World& world, std::uint32_t id) {
  if (!count_at_outlet(world.state, id)) {
    return false;
  }
  world.remove(id);
  return true;
}

}  // namespace clca::automaton
