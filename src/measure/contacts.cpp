#include "clca/measure/contacts.hpp"

#include <algorithm>
#include <tuple>

#include "clca/automaton/separation.hpp"

namespace clca::measure {

namespace {

using automaton::Occupancy;
using automaton::Owner;
using automaton::Particle;
using automaton::Push;
using automaton::State;

/// The other owner of a place of `particle`; kFree where it is alone.
Owner partner(const Occupancy& occupancy, std::size_t index, Owner particle) {
  const Owner second = occupancy.second_owner(index);
  return second == particle ? occupancy.owner(index) : second;
}

/// The contacts of `id` with walls and with greater ids: `sites` and `place` only.
std::vector<Contact> overlaps_of(const State& state, const Occupancy& occupancy, std::uint32_t id) {
  std::vector<Contact> found;
  const Particle& particle = state.particles[id];
  const auto self = static_cast<Owner>(id);
  for (const lattice::Axial part : state.shape(particle).sites()) {
    const lattice::Site site = particle.site() + part;
    const Owner other = partner(occupancy, state.lattice.index(site), self);
    if (other == automaton::kFree || (automaton::is_particle(other) && other < self)) {
      continue;
    }
    auto contact = std::find_if(found.begin(), found.end(),
                                [&](const Contact& known) { return known.second == other; });
    if (contact == found.end()) {
      contact = found.insert(found.end(), {.first = id, .second = other});
    }
    ++contact->sites;
    contact->place += lattice::position(site);
  }
  for (Contact& contact : found) {
    contact.place /= contact.sites;
  }
  std::sort(found.begin(), found.end(),
            [](const Contact& a, const Contact& b) { return a.second < b.second; });
  return found;
}

bool frees_from_wall(const State& state, const Occupancy& occupancy, const Contact& contact,
                     lattice::Direction direction) {
  const Particle& particle = state.particles[contact.first];
  const lattice::Site moved = particle.site() + unit(direction);
  const auto& parts = state.shape(particle).sites();
  return std::none_of(parts.begin(), parts.end(), [&](lattice::Axial part) {
    return occupancy.has(state.lattice.index(moved + part), contact.second);
  });
}

int wall_depth(const State& state, const Occupancy& occupancy, const Contact& contact) {
  const bool one_move = std::any_of(
      lattice::kDirections.begin(), lattice::kDirections.end(),
      [&](lattice::Direction d) { return frees_from_wall(state, occupancy, contact, d); });
  return one_move ? 1 : 2;
}

const Push* find_push(const State& state, std::uint32_t pushed, Owner pusher) {
  const auto key = [](const Push& push) { return std::tuple(push.pushed, push.pusher); };
  const auto wanted = std::tuple(pushed, pusher);
  const auto found =
      std::lower_bound(state.pushes.begin(), state.pushes.end(), wanted,
                       [&](const Push& push, const auto& value) { return key(push) < value; });
  return found != state.pushes.end() && key(*found) == wanted ? &*found : nullptr;
}

}  // namespace

const Push* push_between(const State& state, const Contact& contact) {
  const Push* push = find_push(state, contact.first, contact.second);
  if (push == nullptr && automaton::is_particle(contact.second)) {
    push = find_push(state, static_cast<std::uint32_t>(contact.second),
                     static_cast<Owner>(contact.first));
  }
  return push;
}

std::vector<Contact> contacts(const State& state, const Occupancy& occupancy) {
  std::vector<Contact> result;
  if (!automaton::may_overlap(state)) {
    return result;
  }
  automaton::Separation separation(state);
  for (std::uint32_t id = 0; id < state.particles.size(); ++id) {
    if (!state.particles[id].present) {
      continue;
    }
    for (Contact& contact : overlaps_of(state, occupancy, id)) {
      contact.depth =
          automaton::is_wall(contact.second)
              ? wall_depth(state, occupancy, contact)
              : separation.depth(state.particles[id],
                                 state.particles[static_cast<std::size_t>(contact.second)]);
      if (const Push* push = push_between(state, contact)) {
        contact.source = push->source;
      }
      result.push_back(contact);
    }
  }
  return result;
}

std::vector<double> force_indices(std::size_t particle_count,
                                  const std::vector<Contact>& contacts) {
  std::vector<double> indices(particle_count, 0.0);
  for (const Contact& contact : contacts) {
    indices[contact.first] += contact.sites;
    if (automaton::is_particle(contact.second)) {
      indices[static_cast<std::size_t>(contact.second)] += contact.sites;
    }
  }
  return indices;
}

}  // namespace clca::measure
