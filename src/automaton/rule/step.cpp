#include "automaton/rule/step.hpp"

#include <algorithm>

#include "automaton/rule/moving_walls.hpp"

namespace clca::automaton {

using grains::StepReport;

Steps::Steps(grains::State initial, const Rules& rules)
    : state_(std::move(initial)), box_(state_), world_(box_, rules), decisions_(world_) {}

// 1. Moving walls take the step that their motion asks for, if they can.
void Steps::before_sources() {
  wall_moved_ = advance_walls(world_).moved > 0;
}

// 2. Open sources emit, and at the end 5. outlets remove particles: for all models by grains::step.
bool Steps::advance(StepReport& report) {
  // 3. Every particle chooses a provisional direction. 4. Movers have their turn.
  report.moved = move_particles();

  // The end: settled when no later step can change anything.
  const bool settled = report.moved == 0 && !wall_moved_ && was_quiet() && walls_are_still(world_);
  end_step_of_walls(world_, report.moved > 0);
  ++state_.step;
  return settled;
}

std::vector<std::uint32_t> Steps::moved() const {
  std::vector<std::uint32_t> ids = world_.carried;
  append_moved(ids);
  return ids;
}

std::size_t Reference::move_particles() {
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

void Reference::choose_provisional_directions() {
  grains::State& state = world_.state;
  pushed_.clear();
  others_.clear();
  quiet_ = true;
  std::vector<std::uint32_t> resting;  // known to others only when all have chosen
  for (std::uint32_t id = 0; id < state.particles.size(); ++id) {
    const grains::Particle& particle = state.particles[id];
    if (!particle.present) {
      continue;
    }
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

void Reference::give_turns(std::vector<ProposedMove>& movers,
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

}  // namespace clca::automaton
