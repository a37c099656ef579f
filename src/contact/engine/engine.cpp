#include "contact/engine/engine.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "contact/rule/acceleration.hpp"
#include "contact/rule/moves.hpp"
#include "contact/rule/remainders.hpp"

namespace clca::contact {

Engine::Engine(State& state, grains::Occupancy& occupancy, const grains::FootprintTable& footprints,
               const Rule& rule)
    : state_(state),
      occupancy_(occupancy),
      footprints_(footprints),
      rule_(rule),
      batch_(fastest_functions()),
      finder_(state.grains, occupancy, footprints, rule) {
  reload();
}

void Engine::add_grains() {
  const std::size_t grains = state_.grains.particles.size();
  for (std::size_t id = bodies_.size() - 1; id < grains; ++id) {
    moved_.push_back(static_cast<std::uint32_t>(id));
  }
  bodies_.resize(grains + 1);
  slots_.add_grains(grains);
}

void Engine::remove_grain(std::uint32_t id) {
  velocity(id) = {};
  moved_.push_back(id);
}

void Engine::reload() {
  bodies_.assign(1, {});
  for (const Velocity<std::int32_t>& velocity : state_.velocities) {
    bodies_.push_back({velocity});
  }
  finder_.load(state_.contacts, slots_);
  look_at_all();
}

void Engine::look_at_all() {
  moved_.resize(state_.grains.particles.size());
  std::iota(moved_.begin(), moved_.end(), 0U);
}

void Engine::step() {
  update_contacts();
  accelerate_all();
  sweep_contacts();
  const bool quiet = advance_and_move();
  end_step(state_, quiet && moved_.empty());
}

void Engine::update_contacts() {
  if (const lattice::Direction down = contact::down(state_.vessel); down != finder_.down()) {
    finder_.set_down(down);
    look_at_all();  // which one of two is the upper one may have changed
  }
  const std::size_t first_new = finder_.update(moved_, slots_);
  new_lanes_.clear();
  for (const Slot& slot : slots_.all().subspan(first_new)) {
    new_lanes_.push_back(slot.lane);
  }
  if (sorts_contacts(state_)) {
    finder_.sort(slots_, new_lanes_);
  }
  state_.changed = false;
  for (const std::uint32_t id : moved_) {
    state_.grains.particles[id].previous = grains::kRest;
  }
}

void Engine::accelerate_all() {
  const Acceleration by =
      acceleration(state_.vessel, rule_.gravity, state_.grains.lattice.periodic());
  for (std::size_t id = 0; id < state_.grains.particles.size(); ++id) {
    if (const grains::Particle& grain = state_.grains.particles[id]; grain.present) {
      accelerate(velocity(id), grain.site(), by);
    }
  }
}

void Engine::sweep_contacts() {
  std::vector<Batch>& batches = slots_.batches().all();
  for (const std::int32_t lane : new_lanes_) {
    slots_.batches().bounce(lane) =
        bounce(-separation_velocity(slots_.batches().touching(lane, bodies_)), rule_.restitution);
  }
  batch_.apply(batches.data(), batches.size(), bodies_.data(), rule_.turning.turns);
  for (int i = 0; i < rule_.sweeps; ++i) {
    batch_.sweep(batches.data(), batches.size(), bodies_.data(), rule_.turning, i % 2 != 0);
  }
  for (const std::int32_t lane : new_lanes_) {
    slots_.batches().bounce(lane) = 0;
  }
}

bool Engine::advance_and_move() {
  // No component exceeds half a site before the remainder itself does.
  constexpr std::int64_t kNear = kSpacing / 2 - 2;
  const std::int32_t slow = slow_speed(rule_);
  bool quiet = true;
  candidates_.clear();
  for (std::uint32_t id = 0; id < state_.grains.particles.size(); ++id) {
    if (!state_.grains.particles[id].present) {
      continue;
    }
    quiet = advance(state_.remainders[id], velocity(id), slow) && quiet;
    if (squared(state_.remainders[id]) > kNear * kNear) {
      candidates_.push_back(id);
    }
  }
  moved_.clear();
  move_grains(state_.grains, state_.remainders, occupancy_, footprints_, finder_.down(),
              candidates_, moved_);
  std::sort(moved_.begin(), moved_.end());
  moved_.erase(std::unique(moved_.begin(), moved_.end()), moved_.end());
  for (const std::uint32_t id : candidates_) {
    cut(state_.remainders[id]);
  }
  return quiet;
}

void Engine::write_back() {
  std::transform(bodies_.begin() + 1, bodies_.end(), state_.velocities.begin(),
                 [](const Body& body) { return body.velocity; });
  state_.contacts.clear();
  for (const Slot& slot : slots_.all()) {
    if (slot.lane >= 0) {
      state_.contacts.push_back({.upper = slot.upper,
                                 .other = slot.other,
                                 .normal = slots_.batches().normal(slot.lane),
                                 .impulse = slots_.batches().impulse(slot.lane)});
    }
  }
}

}  // namespace clca::contact
