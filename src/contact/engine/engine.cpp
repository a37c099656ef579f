#include "contact/engine/engine.hpp"

#include <algorithm>
#include <numeric>

#include "contact/rule/contact_list.hpp"
#include "contact/rule/moves.hpp"
#include "contact/rule/remainders.hpp"

namespace clca::contact {

Engine::Engine(State& state, grains::Occupancy& occupancy,
               const grains::FootprintTable& footprints, const Rule& rule)
    : state_(state),
      occupancy_(occupancy),
      footprints_(footprints),
      rule_(rule),
      finder_(state.grains, occupancy, footprints, rule) {
  reload();
}

void Engine::add_grains(std::size_t first) {
  slots_.resize(state_.motions.size());
  for (std::size_t id = first; id < state_.motions.size(); ++id) {
    moved_.push_back(static_cast<std::uint32_t>(id));
  }
}

void Engine::reload() {
  finder_.load(state_.contacts, slots_);
  moved_.resize(state_.motions.size());
  std::iota(moved_.begin(), moved_.end(), 0U);
}

void Engine::step() {
  update_contacts();
  if (rule_.turning.turns) {
    accelerate<true>();
    sweep<true>();
  } else {
    accelerate<false>();
    sweep<false>();
  }
  advance_and_move();
  ++state_.grains.step;
}

void Engine::update_contacts() {
  first_new_ = finder_.update(moved_, slots_);
  for (std::size_t slot = first_new_; slot < slots_.all().size(); ++slot) {
    slots_.all()[slot].is_new = true;
  }
  if (sorts_contacts(state_)) {
    finder_.sort(slots_);
    first_new_ = 0;
  }
  state_.changed = false;
  for (const std::uint32_t id : moved_) {
    state_.grains.particles[id].previous = grains::kRest;
  }
}

template <bool kTurns>
void Engine::accelerate() {
  for (std::size_t id = 0; id < state_.motions.size(); ++id) {
    if (state_.grains.particles[id].present) {
      state_.motions[id].velocity = state_.motions[id].velocity - Vector{0, rule_.gravity};
    }
  }
  std::vector<Slot>& slots = slots_.all();
  for (const Slot& slot : slots) {
    if (slot.pair != nullptr) {
      apply(bodies(slot), slot.contact.normal, slot.contact.shear, slot.contact.rolling, kTurns);
    }
  }
  for (std::size_t i = first_new_; i < slots.size(); ++i) {
    Slot& slot = slots[i];
    if (slot.is_new) {
      slot.bounce = bounce(-separation_velocity(bodies(slot)), rule_.restitution);
    }
  }
}

template <bool kTurns>
void Engine::sweep() {
  Turning turning = rule_.turning;
  turning.turns = kTurns;
  std::vector<Slot>& slots = slots_.all();
  const auto solve_slot = [&](Slot& slot) {
    if (slot.pair != nullptr) {
      solve(slot.contact, bodies(slot), slot.bounce, slot.friction, turning);
    }
  };
  for (int i = 0; i < rule_.sweeps; ++i) {
    if (i % 2 == 0) {
      std::for_each(slots.begin(), slots.end(), solve_slot);
    } else {
      std::for_each(slots.rbegin(), slots.rend(), solve_slot);
    }
  }
  for (std::size_t i = first_new_; i < slots.size(); ++i) {
    slots[i].is_new = false;
    slots[i].bounce = 0;
  }
}

void Engine::advance_and_move() {
  // No component exceeds half a site before the remainder itself does.
  constexpr std::int64_t kNear = kSpacing / 2 - 2;
  const std::int32_t slow = slow_speed(rule_);
  bool quiet = true;
  far_.clear();
  for (std::uint32_t id = 0; id < state_.motions.size(); ++id) {
    Motion& motion = state_.motions[id];
    if (!state_.grains.particles[id].present) {
      continue;
    }
    quiet = advance(motion, slow) && quiet;
    if (squared(motion.remainder) > kNear * kNear) {
      far_.push_back(id);
    }
  }
  moved_.clear();
  move_grains(state_, occupancy_, footprints_, far_, moved_);
  std::sort(moved_.begin(), moved_.end());
  moved_.erase(std::unique(moved_.begin(), moved_.end()), moved_.end());
  for (const std::uint32_t id : far_) {
    cut(state_.motions[id]);
  }
  state_.quiet_steps = quiet && moved_.empty() ? state_.quiet_steps + 1 : 0;
}

void Engine::write_contacts() {
  state_.contacts.clear();
  for (const Slot& slot : slots_.all()) {
    if (slot.pair != nullptr) {
      state_.contacts.push_back(slot.contact);
    }
  }
}

}  // namespace clca::contact
