#include "contact/rule/step.hpp"

#include <algorithm>
#include <functional>
#include <iterator>
#include <numeric>
#include <utility>

#include "clca/contact/contact_model.hpp"
#include "clca/random/draw.hpp"
#include "contact/energy_of.hpp"
#include "contact/rule/acceleration.hpp"
#include "contact/rule/contact_list.hpp"
#include "contact/rule/cuts.hpp"
#include "contact/rule/groups.hpp"
#include "contact/rule/impacts.hpp"
#include "contact/rule/moves.hpp"
#include "contact/rule/remainders.hpp"
#include "contact/rule/touching.hpp"

namespace clca::contact {

namespace {

/// Velocities of bodies in a step. No impulse changes those of walls and sides.
class Velocities {
 public:
  explicit Velocities(State& state) : state_(state), walls_(wall_velocities(state)) {}

  Velocity<std::int32_t>& operator()(grains::Owner body) {
    if (grains::is_particle(body)) {
      return state_.velocities[grains::particle_id(body)];
    }
    return is_side(body) ? side_ : walls_[grains::wall_number(body)];
  }

 private:
  State& state_;
  WallVelocities walls_;
  Velocity<std::int32_t> side_;
};

/// Contacts that carry nothing bounce: new ones, and those whose bodies have parted.
void bounce_loose(std::vector<Touch>& contacts, const grains::State& grains, const Rule& rule,
                  const VelocityOf& velocity_of) {
  for (Touch& touch : contacts) {
    if (touch.contact.impulse.normal == 0) {
      at_contact(touch.contact, grains, rule, velocity_of, [&](const auto& touching) {
        touch.bounce = bounce(-separation_velocity(touching), rule.restitution);
      });
    }
  }
}

/// Solves the impacts in small groups.
void collide(std::vector<Touch>& contacts, const std::vector<std::vector<Touch*>>& groups,
             const grains::State& grains, const Rule& rule, const VelocityOf& velocity_of) {
  for (Touch& touch : contacts) {
    touch.contact.impact = {};
  }
  for (const std::vector<Touch*>& group : groups) {
    if (std::any_of(group.begin(), group.end(),
                    [](const Touch* touch) { return touch->bounce > 0; })) {
      solve_impact(group, grains, rule, velocity_of);
    }
  }
}

void apply_all(const std::vector<Touch>& contacts, const grains::State& grains, const Rule& rule,
               const VelocityOf& velocity_of) {
  for (const Touch& touch : contacts) {
    at_contact(touch.contact, grains, rule, velocity_of,
               [&](auto& touching) { apply(touching, touch.contact.impulse, rule.law.turns); });
  }
}

/// Sweeps alternate forwards and backwards.
void sweep(std::vector<Touch>& contacts, const grains::State& grains, const Rule& rule,
           const VelocityOf& velocity_of) {
  for (int i = 0; i < rule.sweeps; ++i) {
    for (std::size_t k = 0; k < contacts.size(); ++k) {
      Touch& touch = contacts[i % 2 == 0 ? k : contacts.size() - 1 - k];
      Contact& contact = touch.contact;
      at_contact(contact, grains, rule, velocity_of, [&](auto& touching) {
        solve(contact.impulse, touching, touch.bounce, rule.friction_with(contact.other), rule.law);
      });
    }
  }
}

void accelerate_all(State& state, const Rule& rule) {
  const Acceleration by = acceleration(state.vessel, rule.gravity, state.grains.lattice.periodic());
  for (std::size_t id = 0; id < state.velocities.size(); ++id) {
    if (const grains::Particle& grain = state.grains.particles[id]; grain.present) {
      accelerate(state.velocities[id], grain.site(), by);
    }
  }
}

/// Returns whether all grains are at rest.
bool advance_all(State& state, const Rule& rule) {
  std::vector<bool> touching(state.velocities.size(), false);
  for (const Contact& contact : state.contacts) {
    touching[contact.upper] = true;
    if (grains::is_particle(contact.other)) {
      touching[grains::particle_id(contact.other)] = true;
    }
  }
  const UnitVector gravity = gravity_unit(state.vessel);
  bool at_rest = true;
  for (std::uint32_t id = 0; id < state.velocities.size(); ++id) {
    state.grains.particles[id].previous = grains::kRest;
    if (state.grains.particles[id].present) {
      at_rest = advance(state.remainders[id], state.velocities[id], touching[id], slow_speed(rule),
                        gravity) &&
                at_rest;
    }
  }
  return at_rest;
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
  report.moved = move_grains();
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
  return grains_rest(state_, slow_speed(rule_)) && walls_rest(state_);
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

Reference::Reference(State initial, const Parameters& parameters)
    : Steps(std::move(initial), parameters),
      state_(own_state()),
      rule_(rule()),
      normals_(state_.grains.kinds) {}

// Sources and outlets are shared by all models, see grains::step.
std::size_t Reference::move_grains() {
  const lattice::Direction down = this->down();

  // 1. Who touches whom; the contacts in order.
  const std::vector<Touch> now = touches(box(), down, normals_, wall_velocities(state_));
  std::vector<Touch> contacts =
      next_contacts(state_.grains, state_.contacts, now, down, sorts_contacts(state_));
  state_.changed = false;
  Velocities velocities(state_);
  const VelocityOf velocity_of = std::ref(velocities);

  // 2. Contacts without impulse bounce: impacts in small groups at once, others in the sweeps.
  bounce_loose(contacts, state_.grains, rule_, velocity_of);
  const std::vector<std::vector<Touch*>> groups =
      active_groups(contacts, state_.grains.particles.size());
  collide(contacts, groups, state_.grains, rule_, velocity_of);

  // 3. Gravity and the vessel.
  accelerate_all(state_, rule_);

  // 4. The impulses of the last step, once more.
  apply_all(contacts, state_.grains, rule_, velocity_of);

  // 5. Sweeps over the contacts change the impulses and the velocities; in small groups more of
  // them do, which are not remembered.
  sweep(contacts, state_.grains, rule_, velocity_of);
  for (const std::vector<Touch*>& group : groups) {
    finish(group, state_.grains, rule_, velocity_of);
  }
  state_.contacts.clear();
  std::transform(contacts.begin(), contacts.end(), std::back_inserter(state_.contacts),
                 [](const Touch& touch) { return touch.contact; });

  // 6. Remainders of grains, 7. and of walls.
  const bool at_rest = advance_all(state_, rule_);
  std::vector<WallMove> walls = advance_walls(state_);

  // 8. Grains and walls whose remainder is large enough move by a site, if there is room.
  SiteMoves moves(state_, box());
  move_all(moves, state_, down, walls);
  moved_ = moves.moved();

  // 9. Remainders of grains that were held up are cut, and momentum is passed on.
  std::vector<std::uint32_t> ids(state_.remainders.size());
  std::iota(ids.begin(), ids.end(), 0U);
  set_cuts(cut_remainders(state_, moves, rule_, ids, velocity_of));

  // 10. Walls and vessel end the step.
  end_step(state_, walls, {.moved = !moved_.empty(), .advanced = moves.advanced()}, at_rest);
  return moved_.size();
}

}  // namespace clca::contact
