#include "contact/rule/step.hpp"

#include <algorithm>

#include "contact/rule/acceleration.hpp"
#include "contact/rule/contact_list.hpp"
#include "contact/rule/moves.hpp"
#include "contact/rule/remainders.hpp"
#include "contact/rule/touching.hpp"

namespace clca::contact {

namespace {

/// Calls `visit` with a contact and its bodies, whose velocities it may change.
class Contacts {
 public:
  Contacts(State& state, const Rule& rule) : state_(state), rule_(rule) {
    for (std::size_t wall = 0; wall < state.grains.walls.size(); ++wall) {
      walls_.push_back(wall_velocity(state, wall));
    }
  }

  template <class Visit>
  void at(const Touch& touch, Visit visit) {
    const Contact& contact = touch.contact;
    const bool on_wall = !grains::is_particle(contact.other);
    const auto other = static_cast<std::size_t>(contact.other);
    Velocity<std::int32_t> side;
    Velocity<std::int32_t>& upper_velocity = state_.velocities[contact.upper];
    Velocity<std::int32_t>& other_velocity = !on_wall ? state_.velocities[other]
                                             : is_side(contact.other)
                                                 ? side
                                                 : walls_[grains::wall_number(contact.other)];
    ContactState<std::int32_t> touching = {
        .upper = upper_velocity,
        .other = other_velocity,
        .normal_x = contact.normal.x,
        .normal_y = contact.normal.y,
        .pair = rule_.bodies.pair(state_.grains, contact.upper, contact.other)};
    visit(touching);
    upper_velocity = touching.upper;
    other_velocity = touching.other;
  }

 private:
  State& state_;
  const Rule& rule_;
  std::vector<Velocity<std::int32_t>> walls_;  // no impulse changes them
};

/// Target separation velocities of contacts: only new contacts bounce.
std::vector<std::int32_t> bounces(Contacts& all, const std::vector<Touch>& contacts,
                                  std::int32_t restitution) {
  std::vector<std::int32_t> result(contacts.size(), 0);
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    if (contacts[i].is_new) {
      all.at(contacts[i], [&](const ContactState<std::int32_t>& touching) {
        result[i] = bounce(-separation_velocity(touching), restitution);
      });
    }
  }
  return result;
}

/// Sweeps alternate forwards and backwards.
void sweep(Contacts& all, std::vector<Touch>& contacts, const std::vector<std::int32_t>& bounce,
           const Rule& rule) {
  for (int i = 0; i < rule.sweeps; ++i) {
    for (std::size_t k = 0; k < contacts.size(); ++k) {
      const std::size_t at = i % 2 == 0 ? k : contacts.size() - 1 - k;
      Contact& contact = contacts[at].contact;
      all.at(contacts[at], [&](ContactState<std::int32_t>& touching) {
        solve(contact.impulse, touching, bounce[at], rule.friction_with(contact.other), rule.law);
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

void apply_all(Contacts& all, const std::vector<Touch>& contacts, const Rule& rule) {
  for (const Touch& touch : contacts) {
    all.at(touch, [&](ContactState<std::int32_t>& touching) {
      apply(touching, touch.contact.impulse, rule.law.turns);
    });
  }
}

/// Returns whether all grains are at rest.
bool advance_all(State& state, const Rule& rule) {
  std::vector<bool> touching(state.velocities.size(), false);
  for (const Contact& contact : state.contacts) {
    touching[contact.upper] = true;
    if (grains::is_particle(contact.other)) {
      touching[static_cast<std::size_t>(contact.other)] = true;
    }
  }
  bool at_rest = true;
  for (std::uint32_t id = 0; id < state.velocities.size(); ++id) {
    state.grains.particles[id].previous = grains::kRest;
    if (state.grains.particles[id].present) {
      at_rest =
          advance(state.remainders[id], state.velocities[id], touching[id], slow_speed(rule)) &&
          at_rest;
    }
  }
  return at_rest;
}

}  // namespace

std::vector<std::uint32_t> reference_step(State& state, grains::OccupancyTable& occupancy,
                                          const grains::FootprintTable& footprints,
                                          const grains::WallEdges& edges, const Rule& rule,
                                          NormalTable& normals) {
  const lattice::Direction down = contact::down(state.vessel);

  // 1. Who touches whom; the contacts in order.
  std::vector<Touch> contacts = next_contacts(
      state.grains, state.contacts, touches(state.grains, occupancy, footprints, down, normals),
      down, sorts_contacts(state));
  state.changed = false;
  Contacts all(state, rule);

  // 2. New contacts bounce.
  const std::vector<std::int32_t> bounce = bounces(all, contacts, rule.restitution);

  // 3. Gravity and the vessel.
  accelerate_all(state, rule);

  // 4. The impulses of the last step, once more.
  apply_all(all, contacts, rule);

  // 5. Sweeps over the contacts change the impulses and the velocities.
  sweep(all, contacts, bounce, rule);
  state.contacts.clear();
  std::transform(contacts.begin(), contacts.end(), std::back_inserter(state.contacts),
                 [](const Touch& touch) { return touch.contact; });

  // 6. Remainders of grains, 7. and of walls.
  const bool at_rest = advance_all(state, rule);
  std::vector<WallMove> walls = advance_walls(state);

  // 8. Grains and walls whose remainder is large enough move by a site, if there is room.
  SiteMoves moves(state, occupancy, footprints, edges);
  move_all(moves, state, down, walls);

  // 9. Remainders of grains that were held up are cut.
  std::for_each(state.remainders.begin(), state.remainders.end(), cut);

  // 10. Walls and vessel end the step.
  end_step(state, walls, at_rest && moves.moved().empty());
  return moves.moved();
}

}  // namespace clca::contact
