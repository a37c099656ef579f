#include "contact/engine/engine.hpp"

#include <numeric>
#include <utility>

namespace clca::contact {

Engine::Engine(State initial, const Parameters& parameters)
    : ContactMechanics(std::move(initial), parameters),
      carry_out_pass_(fastest_pass_function()),
      finder_(box_, rule_),
      slots_(state_.grains, rule_),
      mover_(state_, box_),
      body_velocities_{
          state_.grains, rule_, [this](grains::Owner body) -> Velocity<>& {
            return bodies_[static_cast<std::size_t>(slots_.body_number(body))].velocity;
          }} {
  load();
}

void Engine::on_added(std::size_t first) {
  ContactMechanics::on_added(first);
  const std::size_t grains = state_.grains.particles.size();
  for (std::size_t id = first; id < grains; ++id) {
    changed_.push_back(static_cast<std::uint32_t>(id));
  }
  bodies_.resize(slots_.first_grain_body() + grains);
  slots_.add_grains(grains);
}

void Engine::on_removing(std::uint32_t id) {
  ContactMechanics::on_removing(id);
  velocity(id) = {};
  changed_.push_back(id);
  mover_.remove_grain(id);
}

void Engine::on_reloaded() {
  write_contacts_back();
  ContactMechanics::on_reloaded();
  load();
}

void Engine::load() {
  bodies_.resize(slots_.first_grain_body());
  for (const Velocity<>& velocity : state_.velocities) {
    bodies_.push_back({velocity});
  }
  finder_.load(state_.contacts, slots_);
  groups_.clear();
  mover_.clear();
  mark_all_changed();
}

void Engine::mark_all_changed() {
  changed_.resize(state_.grains.particles.size());
  std::iota(changed_.begin(), changed_.end(), 0U);
}

void Engine::move_grains() {
  written_back_ = false;
  update_contacts();
  bounce_unloaded_contacts();
  impacts_.clear();
  for_each_group([this](const auto& contacts) { solve_impact(contacts, body_velocities_); });
  accelerate_all(state_, rule_.gravity,
                 [this](std::uint32_t id) -> Velocity<>& { return velocity(id); });
  sweep_contacts();
  advance_and_move();
}

void Engine::update_contacts() {
  if (const lattice::Direction down = this->down(); down != finder_.down()) {
    finder_.set_down(down);
    mark_all_changed();  // which one of two is the upper one may have changed
  }
  const WallVelocities walls = wall_velocities(state_);
  for (std::size_t wall = 0; wall < walls.size(); ++wall) {
    bodies_[kFirstWallBody + wall].velocity = walls[wall];
  }
  finder_.update(changed_, walls, slots_, groups_);
  if (is_sorting_step(state_)) {
    finder_.sort(slots_);
  }
  state_.changed = false;
  for (const std::uint32_t id : changed_) {
    state_.grains.particles[id].previous = grains::kRest;
  }
  groups_.begin_step(state_.grains.particles.size(), slots_);
}

void Engine::bounce_unloaded_contacts() {
  bouncing_.clear();
  for (std::int32_t at = 0; at < static_cast<std::int32_t>(slots_.slots().size()); ++at) {
    const ContactSlot& slot = slots_.slot(at);
    if (slot.lane < 0) {
      continue;
    }
    if (slots_.normal_impulse(at) != 0) {
      groups_.mark_active(slot.upper, slots_);
      continue;
    }
    const std::int32_t velocity =
        bounce_velocity(-slots_.separation_velocity(at, bodies_), rule_.restitution);
    if (velocity > 0) {
      slots_.bounce_velocity(at) = velocity;
      bouncing_.push_back(at);
      groups_.mark_active(slot.upper, slots_);
    }
  }
}

/// Calls `solve` with the contacts of each small group and keeps the impacts.
template <class Solve>
void Engine::for_each_group(Solve solve) {
  for (const std::vector<std::int32_t>& group : groups_.active_slots()) {
    std::vector<StepContact> touches;
    for (const std::int32_t at : group) {
      touches.push_back({.contact = contact(at),
                         .bounce_velocity = std::exchange(slots_.bounce_velocity(at), 0)});
    }
    std::vector<StepContact*> pointers;
    for (StepContact& touch : touches) {
      pointers.push_back(&touch);
    }
    solve(pointers);
    for (std::size_t i = 0; i < group.size(); ++i) {
      impacts_[group[i]] = touches[i].contact.transient;
    }
  }
}

void Engine::sweep_contacts() {
  std::vector<Batch>& batches = slots_.batches();
  const PairCoefficients* pairs = rule_.pair_coefficients.data();
  carry_out_pass_(Pass::warm_start, batches, bodies_.data(), pairs, rule_.law);
  for (int i = 0; i < rule_.sweeps; ++i) {
    carry_out_pass_(i % 2 == 0 ? Pass::forwards : Pass::backwards, batches, bodies_.data(), pairs,
                    rule_.law);
  }
  for (const std::int32_t slot : bouncing_) {
    slots_.bounce_velocity(slot) = 0;
  }
  for_each_group([this](const auto& contacts) { converge_group(contacts, body_velocities_); });
}

void Engine::advance_and_move() {
  // No component exceeds half a site before the remainder itself does.
  constexpr std::int64_t kNear = kSpacing / 2 - 2;
  const bool at_rest = advance_remainders(
      state_, rule_.rest_speed_limit(),
      [this](std::uint32_t id) -> const Velocity<>& { return velocity(id); },
      [this](std::uint32_t id) { return slots_.touches_anything(id); });
  candidates_.resize(state_.remainders.size());
  std::size_t count = 0;
  for (std::uint32_t id = 0; id < candidates_.size(); ++id) {
    candidates_[count] = id;  // overwritten unless counted
    count += squared(state_.remainders[id]) > kNear * kNear ? 1 : 0;
  }
  candidates_.resize(count);
  std::vector<WallMove> walls = advance_walls(state_);
  mover_.move_all(finder_.down(), candidates_, walls);
  const SiteMoves& moves = mover_.site_moves();
  moved_ = moves.moved_ids();
  collide_blocked(state_, moves, body_velocities_, mover_.tried_ids(), last_step_);
  for (std::size_t id = 0; id < state_.velocities.size(); ++id) {
    state_.velocities[id] = velocity(id);
  }
  changed_ = moved_;
  changed_.insert(changed_.end(), moves.grains_beside_walls().begin(),
                  moves.grains_beside_walls().end());
  end_step(state_, walls, moves, rule_.rest_speed_limit(), at_rest);
}

void Engine::write_contacts_back() {
  if (!std::exchange(written_back_, true)) {
    state_.contacts = contacts(true);
  }
}

/// In order; only those with walls and sides unless also those `with_grains`.
std::vector<Contact> Engine::contacts(bool with_grains) const {
  std::vector<Contact> result;
  for (std::int32_t at = 0; at < static_cast<std::int32_t>(slots_.slots().size()); ++at) {
    const ContactSlot& slot = slots_.slot(at);
    if (slot.lane >= 0 && (with_grains || !grains::is_particle(slot.other))) {
      result.push_back(contact(at));
    }
  }
  return result;
}

Contact Engine::contact(std::int32_t at) const {
  Contact result = slots_.contact(at);
  if (const auto impact = impacts_.find(at); impact != impacts_.end()) {
    result.transient = impact->second;
  }
  return result;
}

}  // namespace clca::contact
