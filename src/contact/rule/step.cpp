#include "contact/rule/step.hpp"

#include <algorithm>

#include "contact/rule/contact_list.hpp"
#include "contact/rule/moves.hpp"
#include "contact/rule/remainders.hpp"
#include "contact/rule/touching.hpp"

namespace clca::contact {

namespace {


void accelerate(State& state, std::int32_t gravity) {
  for (std::size_t id = 0; id < state.motions.size(); ++id) {
    if (state.grains.particles[id].present) {
      state.motions[id].velocity = state.motions[id].velocity - Vector{0, gravity};
    }
  }
}

/// The bodies of contacts.
class Pairs {
 public:
  Pairs(State& state, const Bodies& bodies) : state_(state), bodies_(bodies) {}

  Touching operator()(const ActiveContact& active) {
    const Contact& contact = active.contact;
    const bool on_wall = !grains::is_particle(contact.other);
    const auto other = static_cast<std::size_t>(contact.other);
    const auto& grains = state_.grains.particles;
    return {.upper = state_.motions[contact.upper],
            .other = on_wall ? wall_ : state_.motions[other],
            .normal = active.normal,
            .pair = bodies_.pair(grains[contact.upper].kind,
                                 on_wall ? std::nullopt : std::optional(grains[other].kind))};
  }

 private:
  State& state_;
  const Bodies& bodies_;
  Motion wall_;
};

/// The velocities with which contacts are to part: those that are not new do not bounce.
std::vector<std::int32_t> bounces(Pairs& pairs, const std::vector<ActiveContact>& contacts,
                                  std::int32_t restitution) {
  std::vector<std::int32_t> result(contacts.size(), 0);
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    if (contacts[i].is_new) {
      result[i] = bounce(-separation_velocity(pairs(contacts[i])), restitution);
    }
  }
  return result;
}

/// Forwards and backwards in turn.
void sweep(Pairs& pairs, std::vector<ActiveContact>& contacts,
           const std::vector<std::int32_t>& bounce, const Rule& rule) {
  for (int i = 0; i < rule.sweeps; ++i) {
    for (std::size_t k = 0; k < contacts.size(); ++k) {
      const std::size_t at = i % 2 == 0 ? k : contacts.size() - 1 - k;
      Contact& contact = contacts[at].contact;
      solve(contact, pairs(contacts[at]), bounce[at], rule.friction_with(contact.other),
            rule.turning);
    }
  }
}

}  // namespace

std::vector<std::uint32_t> reference_step(State& state, grains::Occupancy& occupancy,
                                          const grains::FootprintTable& footprints,
                                          const Rule& rule, NormalTable& normals) {
  std::vector<ActiveContact> contacts =
      next_contacts(state.grains, state.contacts,
                    touches(state.grains, occupancy, footprints, normals), sorts_contacts(state));
  state.changed = false;

  accelerate(state, rule.gravity);
  Pairs pairs(state, rule.bodies);
  for (const ActiveContact& active : contacts) {
    const Contact& contact = active.contact;
    apply(pairs(active), contact.normal, contact.shear, contact.rolling, rule.turning.turns);
  }
  sweep(pairs, contacts, bounces(pairs, contacts, rule.restitution), rule);
  state.contacts.clear();
  std::transform(contacts.begin(), contacts.end(), std::back_inserter(state.contacts),
                 [](const ActiveContact& active) { return active.contact; });

  const std::int32_t slow = slow_speed(rule);
  bool quiet = true;
  std::vector<std::uint32_t> present;
  for (std::uint32_t id = 0; id < state.motions.size(); ++id) {
    state.grains.particles[id].previous = grains::kRest;
    if (state.grains.particles[id].present) {
      quiet = advance(state.motions[id], slow) && quiet;
      present.push_back(id);
    }
  }
  std::vector<std::uint32_t> moved;
  move_grains(state, occupancy, footprints, present, moved);
  for (const std::uint32_t id : present) {
    cut(state.motions[id]);
  }
  state.quiet_steps = quiet && moved.empty() ? state.quiet_steps + 1 : 0;
  ++state.grains.step;
  return moved;
}

}  // namespace clca::contact
