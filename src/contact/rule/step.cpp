#include "contact/rule/step.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

#include "clca/random/draw.hpp"

namespace clca::contact {

namespace {

/// Contacts that carry nothing bounce: new ones, and those whose bodies have parted.
void bounce_unloaded_contacts(std::vector<StepContact>& contacts, const BodyVelocities& bodies) {
  for (StepContact& touch : contacts) {
    if (touch.contact.impulse.normal == 0) {
      bodies.visit_contact(touch.contact, [&](const auto& both) {
        touch.bounce_velocity =
            bounce_velocity(-separation_velocity(both), bodies.rule.restitution);
      });
    }
  }
}

/// Gives the bodies the impulses of the last step.
void apply_impulses(const std::vector<StepContact>& contacts, const BodyVelocities& bodies) {
  for (const StepContact& touch : contacts) {
    bodies.visit_contact(touch.contact, [&](auto& both) {
      apply_impulse(both, touch.contact.impulse, bodies.rule.law.rotates);
    });
  }
}

/// Sweeps alternate forwards and backwards.
void sweep(std::vector<StepContact>& contacts, const BodyVelocities& bodies) {
  const Rule& rule = bodies.rule;
  for (int i = 0; i < rule.sweeps; ++i) {
    for (std::size_t k = 0; k < contacts.size(); ++k) {
      StepContact& touch = contacts[i % 2 == 0 ? k : contacts.size() - 1 - k];
      Contact& contact = touch.contact;
      bodies.visit_contact(contact, [&](auto& both) {
        solve_contact(contact.impulse, both, touch.bounce_velocity,
                      rule.friction_with(contact.other), rule.law);
      });
    }
  }
}

/// Grains from a source start anywhere within a spacing, or those of one site would stack.
void scatter_remainders(State& state, std::size_t first) {
  for (std::size_t id = first; id < state.remainders.size(); ++id) {
    const std::uint64_t bits =
        random::draw(state.grains.seed, state.grains.step, static_cast<std::uint32_t>(id),
                     random::Purpose::source_remainder);
    state.remainders[id].x =
        static_cast<std::int32_t>(random::uniform_below(bits, kSpacing)) - kSpacing / 2;
  }
}

/// Makes room for the motion of new grains, which are at rest.
void add_motions(State& state) {
  state.velocities.resize(state.grains.particles.size());
  state.remainders.resize(state.grains.particles.size());
  state.from_anchors.resize(state.grains.particles.size());
}

State checked_state(State state) {
  if (state.grains.step == 0 && state.wall_remainders.empty()) {
    state.wall_remainders.resize(state.grains.walls.size());
  }
  if (state.from_anchors.empty()) {
    state.from_anchors.resize(state.grains.particles.size());
  }
  check_valid(state);
  return state;
}

double gravity_in(const lattice::Lattice& box, Parameters parameters) {
  if (parameters.fall_height == 0) {
    parameters.fall_height = std::max(kMinFallHeight, box.extent().y());
  }
  return contact::gravity(parameters);
}

}  // namespace

ContactMechanics::ContactMechanics(State initial, const Parameters& parameters)
    : state_(checked_state(std::move(initial))),
      box_(state_.grains),
      gravity_(gravity_in(state_.grains.lattice, parameters)),
      rule_(make_rule(state_.grains, parameters, gravity_)) {}

void ContactMechanics::on_added(std::size_t first) {
  add_motions(state_);
  scatter_remainders(state_, first);
  for (std::size_t id = first; id < state_.grains.particles.size(); ++id) {
    last_step_.exchange.sources += grain_energy(state_, id, gravity_).sum();
  }
}

bool ContactMechanics::advance(grains::StepReport& report) {
  const std::vector<double> walls = wall_positions(state_);
  const Vessel vessel = state_.vessel;
  move_grains();
  report.moved_count = moved_.size();
  if (wall_positions(state_) != walls) {
    last_step_.exchange.walls = wall_work(state_, wall_contacts(), walls, gravity_) +
                                wall_work(state_, last_step_.blocked_collisions, walls, gravity_);
  }
  if (vessel.is_moving()) {
    last_step_.exchange.vessel = vessel_work(state_, vessel, gravity_);
  }
  if (report.emitted_count > 0) {
    reset_rest_counters(state_);  // what is new still has to fall
  }
  return grains_are_at_rest(state_, rule_.rest_speed_limit()) && walls_are_at_rest(state_);
}

void ContactMechanics::on_removing(std::uint32_t id) {
  last_step_.exchange.outlets += grain_energy(state_, id, gravity_).sum();
  state_.velocities[id] = {};
  state_.remainders[id] = {};
  state_.from_anchors[id] = {};
}

void ContactMechanics::on_reloaded() {
  add_motions(state_);
  state_.changed = true;
  reset_rest_counters(state_);
}

void ContactMechanics::set_vessel(const Vessel& vessel) {
  check_valid(vessel);
  state_.changed = state_.changed || contact::down(vessel) != down();
  state_.vessel = vessel;
  reset_rest_counters(state_);
}

void reset_rest_counters(State& state) {
  state.unmoved_steps = 0;
  state.quiet_steps = 0;
}

std::uint64_t unmoved_steps_at_rest(std::int32_t rest_speed) {
  // A remainder grows from -2 to 1/2 along some direction at most 30 degrees off before it moves.
  constexpr std::int64_t kFarthest = std::int64_t{3} * kSpacing;
  return rest_speed > 0
             ? std::max(kSettlingSteps, static_cast<std::uint64_t>(kFarthest / rest_speed))
             : std::numeric_limits<std::uint64_t>::max();
}

bool grains_are_at_rest(const State& state, std::int32_t rest_speed) {
  return state.quiet_steps >= kSettlingSteps ||
         state.unmoved_steps >= unmoved_steps_at_rest(rest_speed);
}

void end_step(State& state, std::span<const WallMove> walls, const SiteMoves& moves,
              std::int32_t rest_speed, bool at_rest) {
  bool walls_moved = state.vessel.is_moving();
  for (const WallMove& move : walls) {
    grains::Wall& wall = state.grains.walls[move.wall];
    std::int64_t& ahead = state.wall_remainders[move.wall];
    ahead -= move.done ? move.desired * grains::kMotionUnitsPerSpacing : 0;
    record_step(*wall.motion, wall.travel, move.desired, move.done, state.grains.step, ahead);
    walls_moved = walls_moved || move.done;
  }
  state.unmoved_steps = walls_moved || moves.anchor_moved() ? 0 : state.unmoved_steps + 1;
  state.quiet_steps =
      walls_moved || !moves.moved_ids().empty() || !at_rest ? 0 : state.quiet_steps + 1;
  for (const WallMove& move : walls) {
    grains::Wall& wall = state.grains.walls[move.wall];
    grains::end_step(*wall.motion, wall.travel, !grains_are_at_rest(state, rest_speed));
  }
  const lattice::Direction before = down(state.vessel);
  state.vessel = vessel_after_step(state.vessel);
  state.changed = state.changed || down(state.vessel) != before;
  ++state.grains.step;
}

// Sources and outlets are shared by all models, see grains::step.
void ReferenceMechanics::move_grains() {
  const lattice::Direction down = this->down();
  const std::size_t grains = state_.grains.particles.size();
  WallVelocities walls = wall_velocities(state_);
  Velocity<> side;
  const BodyVelocities bodies = {state_.grains, rule_, [&](grains::Owner body) -> Velocity<>& {
                                   if (grains::is_particle(body)) {
                                     return state_.velocities[grains::particle_id(body)];
                                   }
                                   return is_side(body) ? side : walls[grains::wall_number(body)];
                                 }};
  const auto velocity = [&](std::uint32_t id) -> Velocity<>& { return state_.velocities[id]; };

  // 1. Who touches whom; the contacts in order.
  const std::vector<StepContact> now = all_contacts(box_, down, normals_, walls);
  std::vector<StepContact> contacts =
      next_contacts(state_.grains, state_.contacts, now, down, is_sorting_step(state_));
  state_.changed = false;

  // 2. Contacts without impulse bounce: impacts in small groups at once, others in the sweeps.
  bounce_unloaded_contacts(contacts, bodies);
  const std::vector<std::vector<StepContact*>> groups = active_small_groups(contacts, grains);
  for (const std::vector<StepContact*>& group : groups) {
    solve_impact(group, bodies);
  }

  // 3. Gravity and the vessel.
  accelerate_all(state_, rule_.gravity, velocity);

  // 4. The impulses of the last step, once more.
  apply_impulses(contacts, bodies);

  // 5. Sweeps over the contacts change the impulses and the velocities; in small groups more of
  // them do, which are not remembered.
  sweep(contacts, bodies);
  for (const std::vector<StepContact*>& group : groups) {
    converge_group(group, bodies);
  }
  state_.contacts.clear();
  std::vector<bool> has_contact(grains, false);
  for (const StepContact& touch : contacts) {
    state_.contacts.push_back(touch.contact);
    has_contact[touch.contact.upper] = true;
    if (grains::is_particle(touch.contact.other)) {
      has_contact[grains::particle_id(touch.contact.other)] = true;
    }
  }

  // 6. Remainders of grains, 7. and of walls.
  const bool at_rest = advance_remainders(state_, rule_.rest_speed_limit(), velocity,
                                          [&](std::uint32_t id) { return has_contact[id]; });
  std::vector<WallMove> wall_moves = advance_walls(state_);

  // 8. Grains and walls whose remainder is large enough move by a site, if there is room.
  for (grains::Particle& grain : state_.grains.particles) {
    grain.previous = grains::kRest;
  }
  SiteMoves moves(state_, box_);
  move_all(moves, state_, down, wall_moves);
  moved_ = moves.moved_ids();

  // 9. Remainders of grains that were held up are cut, and momentum is passed on.
  std::vector<std::uint32_t> ids(grains);
  std::iota(ids.begin(), ids.end(), 0U);
  collide_blocked(state_, moves, bodies, ids, last_step_);

  // 10. Walls and vessel end the step.
  end_step(state_, wall_moves, moves, rule_.rest_speed_limit(), at_rest);
}

}  // namespace clca::contact
