#include "automaton/rule/step.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "clca/random/draw.hpp"

namespace clca::automaton {

AutomatonMechanics::AutomatonMechanics(grains::State initial, const Rules& rules)
    : state_(std::move(initial)), box_(state_), world_(box_, rules), active_(rules, state_.seed) {}

// 1. Moving walls take the step that their motion asks for, if they can.
void AutomatonMechanics::before_sources() {
  wall_moved_ = advance_walls(world_);
}

// 2. Open sources emit, and at the end 5. outlets remove particles: for all models by grains::step.
bool AutomatonMechanics::advance(grains::StepReport& report) {
  // 3. Every particle chooses a provisional direction. 4. Movers have their turn.
  moved_.clear();
  overlapping_rested_ = true;
  report.moved_count = move_particles();

  // The end: settled when no later step can change anything.
  const bool settled =
      report.moved_count == 0 && !wall_moved_ && overlapping_rested_ && walls_are_still(world_);
  for (grains::Wall& wall : state_.walls) {
    if (wall.in_motion()) {
      end_step(*wall.motion, wall.travel, report.moved_count > 0);
    }
  }
  ++state_.step;
  return settled;
}

std::vector<std::uint32_t> AutomatonMechanics::moved_ids() const {
  std::vector<std::uint32_t> ids = world_.moved_by_walls;
  ids.insert(ids.end(), moved_.begin(), moved_.end());
  append_moved(ids);
  return ids;
}

AutomatonMechanics::Movers AutomatonMechanics::chosen_moves(std::span<const std::uint32_t> ids) {
  Movers movers;
  std::vector<std::uint32_t> resting;  // known to others only when all have chosen
  for (const std::uint32_t id : ids) {
    const bool has_moved = state_.particles[id].previous != grains::kRest;
    overlapping_rested_ = overlapping_rested_ && !(world_.is_overlapping(id) && has_moved);
    const grains::Move move = provisional_move(world_, active_, id);
    if (move == grains::kRest) {
      resting.push_back(id);
      continue;
    }
    (world_.pushes_onto(id).empty() ? movers.others : movers.pushed)
        .push_back(
            {update_key(world_.rules, state_, id, move), static_cast<lattice::Direction>(move)});
  }
  for (const std::uint32_t id : resting) {
    state_.particles[id].previous = grains::kRest;
  }
  return movers;
}

void AutomatonMechanics::give_turns(std::vector<ProposedMove>& movers,
                                    bool (*move)(World&, std::uint32_t, lattice::Direction)) {
  std::ranges::sort(movers, {}, &ProposedMove::key);
  for (const ProposedMove& mover : movers) {
    const std::uint32_t id = mover.key.id;
    if (move(world_, id, mover.direction)) {
      moved_.push_back(id);
    } else {
      // Who finds the way taken rests.
      state_.particles[id].previous = grains::kRest;
    }
  }
}

std::size_t ReferenceMechanics::move_particles() {
  std::vector<std::uint32_t> ids(world_.state.particles.size());
  std::iota(ids.begin(), ids.end(), 0U);
  std::erase_if(ids, [&](std::uint32_t id) { return !world_.state.particles[id].present; });
  // 3. Every particle chooses a provisional direction, from the state at this moment alone.
  Movers movers = chosen_moves(ids);
  // 4. Movers have their turn in order of priority: first those pushed onto, then the others.
  give_turns(movers.pushed, &try_move_pushed);
  give_turns(movers.others, &try_move_by_itself);
  world_.changes = {.by_others = false};
  return moved_.size();
}

// The order in which movers have their turn.

namespace {

/// The first class that fits.
std::uint64_t class_of(const Rules& rules, grains::Move previous, grains::Move move) {
  const auto fits = [&](UpdateClass update_class) {
    switch (update_class) {
      case UpdateClass::rest:
        return previous == grains::kRest;
      case UpdateClass::inertia:
        return previous == move;
      case UpdateClass::gravity:
        return move == static_cast<grains::Move>(rules.gravity);
    }
    return false;
  };
  const auto& classes = rules.update_priority;
  return static_cast<std::uint64_t>(std::ranges::find_if(classes, fits) - classes.begin());
}

/// TieBreaking::direction: gravity first, then pairs at the same angle to it, each in the order of
/// a coin for the class and the step.
std::uint64_t direction_tie(const Rules& rules, const grains::State& state, grains::Move move,
                            std::uint64_t update_class) {
  const auto direction = static_cast<lattice::Direction>(move);
  const auto angle = static_cast<std::uint64_t>(lattice::sixths_between(rules.gravity, direction));
  const bool clockwise = rotated(rules.gravity, static_cast<int>(angle)) == direction;
  const auto coin = random::draw(state.seed, state.step, static_cast<std::uint32_t>(update_class),
                                 random::Purpose::direction_order);
  const bool clockwise_first = (coin & 1U) == 0;
  return 2 * angle + (clockwise == clockwise_first ? 0 : 1);
}

}  // namespace

UpdateKey update_key(const Rules& rules, const grains::State& state, std::uint32_t id,
                     grains::Move move) {
  const std::uint64_t update_class = class_of(rules, state.particles[id].previous, move);
  switch (rules.ties) {
    case TieBreaking::particle:
      return {update_class, random::draw(state.seed, state.step, id, random::Purpose::tie), id};
    case TieBreaking::direction:
      return {update_class, direction_tie(rules, state, move, update_class), id};
  }
  return {update_class, 0, id};
}

}  // namespace clca::automaton
