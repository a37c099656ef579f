#include "contact/engine/engine.hpp"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <utility>

#include "contact/rule/acceleration.hpp"
#include "contact/rule/cuts.hpp"
#include "contact/rule/remainders.hpp"

namespace clca::contact {

namespace {

std::vector<Touch*> pointers(std::vector<Touch>& touches) {
  std::vector<Touch*> result;
  std::transform(touches.begin(), touches.end(), std::back_inserter(result),
                 [](Touch& touch) { return &touch; });
  return result;
}

}  // namespace

Engine::Engine(State initial, const Parameters& parameters, grains::PhaseTimes* phase_times)
    : Steps(std::move(initial), parameters),
      state_(own_state()),
      rule_(rule()),
      phase_times_(phase_times),
      clock_(phase_times),
      batch_(fastest_functions()),
      finder_(box(), rule_),
      slots_(state_.grains, rule_),
      mover_(state_, box()),
      first_grain_(slots_.batches().first_grain()) {
  load();
}

void Engine::added(std::size_t first) {
  Steps::added(first);
  const std::size_t grains = state_.grains.particles.size();
  for (std::size_t id = first; id < grains; ++id) {
    changed_.push_back(static_cast<std::uint32_t>(id));
  }
  bodies_.resize(first_grain_ + grains);
  slots_.add_grains(grains);
}

void Engine::removing(std::uint32_t id) {
  Steps::removing(id);
  velocity(id) = {};
  changed_.push_back(id);
  mover_.remove_grain(id);
}

void Engine::reloaded() {
  write_back();
  Steps::reloaded();
  load();
}

void Engine::load() {
  load_bodies();
  finder_.load(state_.contacts, slots_);
  groups_.clear();
  mover_.clear();
  look_at_all();
}

void Engine::load_bodies() {
  bodies_.resize(first_grain_);
  for (const Velocity<std::int32_t>& velocity : state_.velocities) {
    bodies_.push_back({velocity});
  }
}

void Engine::look_at_all() {
  changed_.resize(state_.grains.particles.size());
  std::iota(changed_.begin(), changed_.end(), 0U);
}

std::size_t Engine::move_grains() {
  written_back_ = false;
  clock_ = grains::PhaseClock(phase_times_);
  update_contacts();
  set_walls();
  bounce_loose();
  collide();
  accelerate_all();
  clock_.end("motion");
  sweep_contacts();
  advance_and_move();
  clock_.end("moves");
  return moved_.size();
}

void Engine::update_contacts() {
  if (const lattice::Direction down = contact::down(state_.vessel); down != finder_.down()) {
    finder_.set_down(down);
    look_at_all();  // which one of two is the upper one may have changed
  }
  finder_.update(changed_, wall_velocities(state_), slots_, groups_);
  clock_.end("contacts");
  if (sorts_contacts(state_)) {
    finder_.sort(slots_);
  }
  state_.changed = false;
  for (const std::uint32_t id : changed_) {
    state_.grains.particles[id].previous = grains::kRest;
  }
  clock_.end("order");
  groups_.begin(state_.grains.particles.size(), slots_);
}

void Engine::set_walls() {
  for (std::size_t wall = 0; wall < state_.grains.walls.size(); ++wall) {
    bodies_[kFirstWallBody + wall].velocity = wall_velocity(state_, wall);
  }
}

void Engine::bounce_loose() {
  Batches& batches = slots_.batches();
  bouncing_.clear();
  for (std::int32_t at = 0; at < static_cast<std::int32_t>(slots_.all().size()); ++at) {
    const Slot& slot = slots_.at(at);
    const std::int32_t lane = slot.lane;
    if (lane < 0) {
      continue;
    }
    if (batches.normal_impulse(lane) != 0) {
      groups_.set_active(slot.upper, slots_);
      continue;
    }
    const std::int32_t velocity =
        bounce(-separation_velocity(batches.touching(lane, bodies_)), rule_.restitution);
    if (velocity > 0) {
      batches.bounce(lane) = velocity;
      bouncing_.push_back(at);
      groups_.set_active(slot.upper, slots_);
    }
  }
}

void Engine::collide() {
  touches_.clear();
  for (const std::vector<std::int32_t>& group : groups_.active()) {
    std::vector<Touch>& touches = touches_.emplace_back();
    bool bounces = false;
    for (const std::int32_t slot : group) {
      std::int32_t& bounce = slots_.batches().bounce(slots_.at(slot).lane);
      touches.push_back({.contact = slots_.contact(slot), .bounce = bounce});
      bounces = bounces || bounce > 0;
      bounce = 0;
    }
    if (bounces) {
      solve_impact(pointers(touches), state_.grains, rule_, velocity_of());
    }
  }
}

void Engine::accelerate_all() {
  const Acceleration by =
      acceleration(state_.vessel, rule_.gravity, state_.grains.lattice.periodic());
  const std::vector<grains::Particle>& particles = state_.grains.particles;
  for (std::size_t id = 0; id < particles.size(); ++id) {
    if (particles[id].present) {
      accelerate(velocity(id), particles[id].site(), by);
    }
  }
}

void Engine::sweep_contacts() {
  std::vector<Batch>& batches = slots_.batches().all();
  const Pair* pairs = rule_.bodies.pairs().data();
  batch_.apply(batches.data(), batches.size(), bodies_.data(), pairs, rule_.law.turns);
  clock_.end("warm_start");
  for (int i = 0; i < rule_.sweeps; ++i) {
    batch_.sweep(batches.data(), batches.size(), bodies_.data(), pairs, rule_.law, i % 2 != 0);
  }
  for (const std::int32_t slot : bouncing_) {
    slots_.batches().bounce(slots_.at(slot).lane) = 0;
  }
  finish_groups();
  clock_.end("sweeps");
}

void Engine::finish_groups() {
  impacts_.clear();
  for (std::size_t i = 0; i < touches_.size(); ++i) {
    const std::vector<std::int32_t>& group = groups_.active()[i];
    std::vector<Touch>& touches = touches_[i];
    for (std::size_t k = 0; k < group.size(); ++k) {
      touches[k].contact.impulse = slots_.contact(group[k]).impulse;
    }
    finish(pointers(touches), state_.grains, rule_, velocity_of());
    for (std::size_t k = 0; k < group.size(); ++k) {
      impacts_.emplace_back(group[k], touches[k].contact.impact);
    }
  }
  std::sort(impacts_.begin(), impacts_.end(),
            [](const auto& one, const auto& other) { return one.first < other.first; });
}

void Engine::advance_and_move() {
  // No component exceeds half a site before the remainder itself does.
  constexpr std::int64_t kNear = kSpacing / 2 - 2;
  const std::int32_t slow = slow_speed(rule_);
  const UnitVector gravity = gravity_unit(state_.vessel);
  const std::vector<grains::Particle>& particles = state_.grains.particles;
  bool at_rest = true;
  candidates_.resize(particles.size());
  std::size_t count = 0;
  for (std::uint32_t id = 0; id < particles.size(); ++id) {
    if (!particles[id].present) {
      continue;
    }
    Vector& remainder = state_.remainders[id];
    at_rest =
        contact::advance(remainder, velocity(id), slots_.touches_anything(id), slow, gravity) &&
        at_rest;
    candidates_[count] = id;  // overwritten unless counted
    count += squared(remainder) > kNear * kNear ? 1 : 0;
  }
  candidates_.resize(count);
  clock_.end("motion");
  std::vector<WallMove> walls = advance_walls(state_);
  mover_.move_all(finder_.down(), candidates_, walls);
  const SiteMoves& moves = mover_.moves();
  moved_ = moves.moved();
  set_cuts(cut_remainders(state_, moves, rule_, mover_.ids(), velocity_of()));
  changed_ = moved_;
  changed_.insert(changed_.end(), moves.beside_walls().begin(), moves.beside_walls().end());
  end_step(state_, walls, {.moved = !moved_.empty(), .advanced = moves.advanced()}, at_rest);
}

void Engine::write_back() {
  if (written_back_) {
    return;
  }
  written_back_ = true;
  write_back_velocities();
  state_.contacts = contacts([](const Slot& /*slot*/) { return true; });
}

void Engine::write_back_velocities() {
  std::transform(bodies_.begin() + static_cast<std::ptrdiff_t>(first_grain_), bodies_.end(),
                 state_.velocities.begin(), [](const Body& body) { return body.velocity; });
}

std::vector<Contact> Engine::wall_contacts() const {
  return contacts([](const Slot& slot) { return !grains::is_particle(slot.other); });
}

/// Those that `chosen` returns true for, in order.
template <class Chosen>
std::vector<Contact> Engine::contacts(Chosen chosen) const {
  std::vector<Contact> result;
  auto impact = impacts_.begin();
  for (std::int32_t at = 0; at < static_cast<std::int32_t>(slots_.all().size()); ++at) {
    const Slot& slot = slots_.at(at);
    const bool is_impact = impact != impacts_.end() && impact->first == at;
    if (slot.lane >= 0 && chosen(slot)) {
      result.push_back(slots_.contact(at));
      if (is_impact) {
        result.back().impact = impact->second;
      }
    }
    impact += is_impact ? 1 : 0;
  }
  return result;
}

}  // namespace clca::contact
