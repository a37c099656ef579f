#include "contact/rule/sleep.hpp"

#include <algorithm>
#include <cstdlib>

#include "contact/rule/acceleration.hpp"
#include "contact/rule/walls.hpp"

namespace clca::contact {

namespace {

/// The impulses on a grain.
struct GrainImpulses {
  std::int64_t x = 0;
  std::int64_t y = 0;
  std::int64_t normal = 0;  // sum of their sizes
};

void add(std::vector<GrainImpulses>& loads, const Contact& contact) {
  const auto [normal, shear, rolling] = contact.impulse;
  const UnitVector& unit = contact.normal;
  const std::int64_t x = scaled(product(normal, unit.x) - product(shear, unit.y), kUnitBits);
  const std::int64_t y = scaled(product(normal, unit.y) + product(shear, unit.x), kUnitBits);
  GrainImpulses& upper = loads[contact.upper];
  upper = {upper.x + x, upper.y + y, upper.normal + normal};
  if (grains::is_particle(contact.other)) {
    GrainImpulses& other = loads[static_cast<std::size_t>(contact.other)];
    other = {other.x - x, other.y - y, other.normal + normal};
  }
}

bool is_out_of_balance(const GrainImpulses& load, std::int32_t mass, const Rule& rule,
                       const Vector& gravity) {
  const auto weight = [&](std::int32_t component) {
    return scaled(product(mass, component), kMassBits);
  };
  const std::int64_t most = weight(rule.gravity) + load.normal / 8;
  return std::abs(load.x + weight(gravity.x)) > most || std::abs(load.y + weight(gravity.y)) > most;
}

/// Moves contacts between the active and sleeping lists.
void sort_out(State& state) {
  const auto belongs_to_sleep = [&](const Contact& contact) {
    return both_asleep(state.sleep, contact.upper, contact.other);
  };
  const auto move_behind = [](std::vector<Contact>& from, auto first, std::vector<Contact>& to) {
    to.insert(to.end(), first, from.end());
    from.erase(first, from.end());
  };
  std::vector<Contact>& asleep = state.sleep.contacts;
  const auto woken = std::stable_partition(asleep.begin(), asleep.end(), belongs_to_sleep);
  std::vector<Contact> now_awake;
  move_behind(asleep, woken, now_awake);
  const auto fallen = std::stable_partition(state.contacts.begin(), state.contacts.end(),
                                            std::not_fn(belongs_to_sleep));
  move_behind(state.contacts, fallen, asleep);
  state.contacts.insert(state.contacts.end(), now_awake.begin(), now_awake.end());
}

}  // namespace

const Pair& coefficients(const grains::State& grains, const Sleep& sleep, const Bodies& bodies,
                         std::uint32_t upper, grains::Owner other) {
  const auto kind = [&](std::size_t id) { return grains.particles[id].kind; };
  if (!grains::is_particle(other)) {
    return bodies.pair(kind(upper), std::nullopt);
  }
  const auto id = static_cast<std::size_t>(other);
  const Bodies::Fixed fixed = is_asleep(sleep, id)      ? Bodies::Fixed::other
                              : is_asleep(sleep, upper) ? Bodies::Fixed::upper
                                                        : Bodies::Fixed::none;
  return bodies.pair(kind(upper), kind(id), fixed);
}

void check_sleep(State& state, const Rule& rule) {
  if (state.vessel.moves() || walls_move(state)) {
    wake_all(state);
    return;
  }
  std::vector<GrainImpulses> loads(state.velocities.size());
  for (const Contact& contact : state.contacts) {
    add(loads, contact);
  }
  for (const Contact& contact : state.sleep.contacts) {
    add(loads, contact);
  }
  const Vector gravity =
      acceleration(state.vessel, rule.gravity, state.grains.lattice.periodic()).gravity;
  const std::int64_t slow = rule.gravity / 4;
  for (std::size_t id = 0; id < state.velocities.size(); ++id) {
    std::uint8_t& rests = state.sleep.rests[id];
    Velocity<std::int32_t>& velocity = state.velocities[id];
    if (rests >= kAsleep) {
      const std::int32_t mass = rule.bodies.mass(state.grains.particles[id].kind);
      if (rests == kDisturbed || is_out_of_balance(loads[id], mass, rule, gravity)) {
        rests = 0;
      }
    } else if (loads[id].normal > 0 && squared({velocity.x, velocity.y}) <= slow * slow) {
      ++rests;
      if (rests == kAsleep) {
        velocity = {};
        state.remainders[id] = {};
      }
    } else {
      rests = 0;
    }
  }
  sort_out(state);
}

void wake_all(State& state) {
  std::fill(state.sleep.rests.begin(), state.sleep.rests.end(), std::uint8_t{0});
  sort_out(state);
}

}  // namespace clca::contact
