#include "contact/rule/step.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "clca/random/draw.hpp"

namespace clca::contact {

namespace {

/// Contacts that carry nothing bounce: new ones, and those whose bodies have parted.
void bounce_loose(std::vector<StepContact>& contacts, const BodyVelocities& bodies) {
  for (StepContact& touch : contacts) {
    if (touch.contact.impulse.normal == 0) {
      bodies.at(touch.contact, [&](const auto& touching) {
        touch.bounce = bounce(-separation_velocity(touching), bodies.rule.restitution);
      });
    }
  }
}

void apply_all(const std::vector<StepContact>& contacts, const BodyVelocities& bodies) {
  for (const StepContact& touch : contacts) {
    bodies.at(touch.contact, [&](auto& touching) {
      apply(touching, touch.contact.impulse, bodies.rule.law.rotates);
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
      bodies.at(contact, [&](auto& touching) {
        solve(contact.impulse, touching, touch.bounce, rule.friction_with(contact.other), rule.law);
      });
    }
  }
}

/// Grains from a source start anywhere within a spacing; otherwise those of one site would stack
/// vertically.
void scatter(State& state, std::size_t first) {
  for (std::size_t id = first; id < state.remainders.size(); ++id) {
    const std::uint64_t bits =
        random::draw(state.grains.seed, state.grains.step, static_cast<std::uint32_t>(id),
                     random::Purpose::source_remainder);
    state.remainders[id].x =
        static_cast<std::int32_t>(random::below(bits, kSpacing)) - kSpacing / 2;
  }
}

/// Grains that are at rest.
void add_motions(State& state) {
  state.velocities.resize(state.grains.particles.size());
  state.remainders.resize(state.grains.particles.size());
  state.from_anchors.resize(state.grains.particles.size());
}

State valid(State state) {
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
    parameters.fall_height = default_fall_height(box.size().y());
  }
  return contact::gravity(parameters);
}

Eigen::Vector2d in_spacings(std::int32_t x, std::int32_t y) {
  return std::ldexp(1, -kFractionBits) * Eigen::Vector2d(x, y);
}

Eigen::Vector2d in_spacings(const Vector& vector) {
  return in_spacings(vector.x, vector.y);
}

double mass_of(const State& state, std::size_t id) {
  return static_cast<double>(state.grains.shape(state.grains.particles[id]).size());
}

/// Centre of mass.
Eigen::Vector2d position_of(const State& state, std::size_t id) {
  return grains::centre(state.grains, state.grains.particles[id]) +
         in_spacings(state.remainders[id]);
}

/// Of a present grain, in units of Energy; `gravity` in lattice spacings per step squared.
Energy energy_of(const State& state, std::size_t id, double gravity) {
  const Velocity<>& velocity = state.velocities[id];
  const double mass = mass_of(state, id);
  const double spin = static_cast<double>(velocity.spin) / kSpacing;
  return {.kinetic = mass * (in_spacings(velocity.x, velocity.y).squaredNorm() + spin * spin / 2) /
                     2 / gravity,
          .potential = -mass * gravity_direction(state.vessel).dot(position_of(state, id))};
}

/// Positions of the walls along their motions, in lattice spacings: a wall that follows its motion
/// is where that is, one that lags by more than a spacing moves by sites.
std::vector<double> wall_positions(const State& state) {
  std::vector<double> result;
  for (std::size_t wall = 0; wall < state.wall_remainders.size(); ++wall) {
    const double ahead = static_cast<double>(state.wall_remainders[wall]) /
                         static_cast<double>(grains::kMotionSpacing);
    result.push_back(state.grains.walls[wall].travel.offset + std::clamp(ahead, -1.0, 1.0));
  }
  return result;
}

/// Work of walls in the step that led to `state`: impulses times displacements. `contacts`: those
/// with walls, others do not count; `before`: wall_positions.
double wall_work(const State& state, std::span<const Contact> contacts,
                 const std::vector<double>& before, double gravity) {
  const std::vector<double> now = wall_positions(state);
  double sum = 0;
  for (const Contact& contact : contacts) {
    if (grains::is_particle(contact.other) || is_side(contact.other)) {
      continue;
    }
    const std::size_t wall = grains::wall_number(contact.other);
    if (const auto& motion = state.grains.walls[wall].motion) {
      const Eigen::Vector2d normal = as_double(contact.normal);
      const Eigen::Vector2d tangent(-normal.y(), normal.x());
      const Eigen::Vector2d impulse = ((contact.impulse.normal + contact.impact.normal) * normal +
                                       (contact.impulse.shear + contact.impact.shear) * tangent) /
                                      kSpacing;
      sum += (now[wall] - before[wall]) *
             impulse.dot(lattice::position(lattice::unit(motion->direction)));
    }
  }
  return sum * mass_unit(state.grains.kinds) / gravity;
}

/// Work of the vessel in the step that led to `state`; `before`: the vessel as it began.
double vessel_work(const State& state, const Vessel& before, double gravity) {
  const bool periodic = state.grains.lattice.periodic();
  const auto integer_gravity = static_cast<std::int32_t>(gravity * kSpacing);
  const Acceleration by = acceleration(before, integer_gravity, periodic);
  const Vector still = acceleration(at_rest(before), integer_gravity, periodic).gravity;
  const Eigen::Vector2d shaking = in_spacings(by.gravity) - in_spacings(still);
  const double squared_rate = std::ldexp(static_cast<double>(by.squared_rate), -kCentrifugalBits);
  const Eigen::Vector2d centre =
      std::ldexp(1, -kCentreBits) * Eigen::Vector2d(by.centre_x, by.centre_y);
  const Eigen::Vector2d turn = gravity_direction(state.vessel) - gravity_direction(before);
  Eigen::Vector2d momentum = Eigen::Vector2d::Zero();
  Eigen::Vector2d moment = Eigen::Vector2d::Zero();  // mass times position
  double outwards = 0;                               // mass times velocity from the centre
  for (std::size_t id = 0; id < state.velocities.size(); ++id) {
    if (const grains::Particle& grain = state.grains.particles[id]; grain.present) {
      const Eigen::Vector2d impulse =
          mass_of(state, id) * in_spacings(state.velocities[id].x, state.velocities[id].y);
      momentum += impulse;
      moment += mass_of(state, id) * position_of(state, id);
      outwards += impulse.dot(lattice::position(grain.site()) - centre);
    }
  }
  return (shaking.dot(momentum) + squared_rate * outwards) / gravity - turn.dot(moment);
}

}  // namespace

Steps::Steps(State initial, const Parameters& parameters)
    : state_(valid(std::move(initial))),
      box_(state_.grains),
      gravity_(gravity_in(state_.grains.lattice, parameters)),
      rule_(make_rule(state_.grains, parameters, gravity_)) {}

void Steps::added(std::size_t first) {
  add_motions(state_);
  scatter(state_, first);
  for (std::size_t id = first; id < state_.grains.particles.size(); ++id) {
    exchange_.sources += energy_of(state_, id, gravity_).sum();
  }
}

bool Steps::advance(grains::StepReport& report) {
  const std::vector<double> walls = wall_positions(state_);
  const Vessel vessel = state_.vessel;
  move_grains();
  report.moved = moved_.size();
  if (wall_positions(state_) != walls) {
    exchange_.walls = wall_work(state_, wall_contacts(), walls, gravity_) +
                      wall_work(state_, cuts_.pushes, walls, gravity_);
  }
  if (vessel.moves() || !state_.grains.outlets.empty()) {
    write_back_velocities();
  }
  if (vessel.moves()) {
    exchange_.vessel = vessel_work(state_, vessel, gravity_);
  }
  if (report.emitted > 0) {
    disturb(state_);  // what is new still has to fall
  }
  return grains_rest(state_, rule_.slow_speed()) && walls_rest(state_);
}

void Steps::removing(std::uint32_t id) {
  exchange_.outlets += energy_of(state_, id, gravity_).sum();
  state_.velocities[id] = {};
  state_.remainders[id] = {};
  state_.from_anchors[id] = {};
}

void Steps::reloaded() {
  add_motions(state_);
  state_.changed = true;
  disturb(state_);
}

void Steps::set_vessel(const Vessel& vessel) {
  check_valid(vessel);
  state_.changed = state_.changed || contact::down(vessel) != down();
  state_.vessel = vessel;
  disturb(state_);
}

void disturb(State& state) {
  state.unmoved_steps = 0;
  state.quiet_steps = 0;
}

bool grains_rest(const State& state, std::int32_t slow) {
  // A remainder grows from -2 to 1/2 along some direction at most 30 degrees off before it moves.
  constexpr std::int64_t kFarthest = std::int64_t{3} * kSpacing;
  return state.quiet_steps >= kQuietSteps ||
         (slow > 0 && state.unmoved_steps >=
                          std::max(kQuietSteps, static_cast<std::uint64_t>(kFarthest / slow)));
}

void end_step(State& state, std::span<const WallMove> walls, const SiteMoves& moves, bool at_rest) {
  bool walls_moved = state.vessel.moves();
  for (const WallMove& move : walls) {
    grains::Wall& wall = state.grains.walls[move.wall];
    std::int64_t& ahead = state.wall_remainders[move.wall];
    ahead -= move.done ? move.desired * grains::kMotionSpacing : 0;
    take_step(*wall.motion, wall.travel, move.desired, move.done, state.grains.step, ahead);
    walls_moved = walls_moved || move.done;
  }
  state.unmoved_steps = walls_moved || moves.advanced() ? 0 : state.unmoved_steps + 1;
  state.quiet_steps = walls_moved || !moves.moved().empty() || !at_rest ? 0 : state.quiet_steps + 1;
  for (const WallMove& move : walls) {
    grains::Wall& wall = state.grains.walls[move.wall];
    grains::end_step(*wall.motion, wall.travel, state.quiet_steps < kQuietSteps);
  }
  const lattice::Direction before = down(state.vessel);
  state.vessel = next(state.vessel);
  state.changed = state.changed || down(state.vessel) != before;
  ++state.grains.step;
}

// Sources and outlets are shared by all models, see grains::step.
void Reference::move_grains() {
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
      next_contacts(state_.grains, state_.contacts, now, down, sorts_contacts(state_));
  state_.changed = false;

  // 2. Contacts without impulse bounce: impacts in small groups at once, others in the sweeps.
  bounce_loose(contacts, bodies);
  const std::vector<std::vector<StepContact*>> groups = active_groups(contacts, grains);
  for (const std::vector<StepContact*>& group : groups) {
    solve_impact(group, bodies);
  }

  // 3. Gravity and the vessel.
  accelerate_all(state_, rule_.gravity, velocity);

  // 4. The impulses of the last step, once more.
  apply_all(contacts, bodies);

  // 5. Sweeps over the contacts change the impulses and the velocities; in small groups more of
  // them do, which are not remembered.
  sweep(contacts, bodies);
  for (const std::vector<StepContact*>& group : groups) {
    converge_group(group, bodies);
  }
  state_.contacts.clear();
  std::vector<bool> touching(grains, false);
  for (const StepContact& touch : contacts) {
    state_.contacts.push_back(touch.contact);
    touching[touch.contact.upper] = true;
    if (grains::is_particle(touch.contact.other)) {
      touching[grains::particle_id(touch.contact.other)] = true;
    }
  }

  // 6. Remainders of grains, 7. and of walls.
  const bool at_rest = advance_all(state_, rule_.slow_speed(), velocity,
                                   [&](std::uint32_t id) { return touching[id]; });
  std::vector<WallMove> wall_moves = advance_walls(state_);

  // 8. Grains and walls whose remainder is large enough move by a site, if there is room.
  for (grains::Particle& grain : state_.grains.particles) {
    grain.previous = grains::kRest;
  }
  SiteMoves moves(state_, box_);
  move_all(moves, state_, down, wall_moves);
  moved_ = moves.moved();

  // 9. Remainders of grains that were held up are cut, and momentum is passed on.
  std::vector<std::uint32_t> ids(grains);
  std::iota(ids.begin(), ids.end(), 0U);
  cuts_ = collide_blocked(state_, moves, bodies, ids);

  // 10. Walls and vessel end the step.
  end_step(state_, wall_moves, moves, at_rest);
}

}  // namespace clca::contact
