#include "clca/measure/contacts.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "measure/internal/sites.hpp"

namespace clca::measure {

namespace {

using grains::Occupancy;
using grains::Owner;
using grains::Particle;
using grains::Push;
using grains::State;

/// Sets `sites` and `point` of an overlap.
OverlapContact shared_by(const State& state, const Occupancy& occupancy, std::uint32_t first,
                         Owner second) {
  OverlapContact contact = {.first = first, .second = second};
  const Particle& particle = state.particles[first];
  for (const lattice::Axial part : state.shape(particle).sites()) {
    const lattice::Site site = particle.site() + part;
    if (occupancy.has(state.lattice.index(site), second)) {
      ++contact.sites;
      contact.point += lattice::position(site);
    }
  }
  contact.point = state.lattice.in_box(contact.point / std::max(1, contact.sites));
  return contact;
}

/// See OverlapContact::depth.
int depth_of(const State& state, const Occupancy& occupancy, const OverlapContact& contact) {
  const Particle& particle = state.particles[contact.first];
  const auto& parts = state.shape(particle).sites();
  const bool one_move = std::any_of(
      lattice::kDirections.begin(), lattice::kDirections.end(), [&](lattice::Direction direction) {
        const lattice::Site moved = particle.site() + unit(direction);
        return std::none_of(parts.begin(), parts.end(), [&](lattice::Axial part) {
          return occupancy.has(state.lattice.index(moved + part), contact.second);
        });
      });
  return one_move ? 1 : 2;
}

}  // namespace

const Push* push_between(const State& state, const OverlapContact& contact) {
  const Push* push = find_push(state, contact.first, contact.second);
  if (push == nullptr && grains::is_particle(contact.second)) {
    push = find_push(state, static_cast<std::uint32_t>(contact.second),
                     grains::as_owner(contact.first));
  }
  return push;
}

// Every overlapping pair has one push.
std::vector<OverlapContact> contacts(const State& state, const Occupancy& occupancy) {
  check_occupancy(state, occupancy);
  std::vector<OverlapContact> result;
  result.reserve(state.pushes.size());
  for (const Push& push : state.pushes) {
    const bool by_particle = grains::is_particle(push.pusher);
    const auto pusher = static_cast<std::uint32_t>(push.pusher);
    const bool swapped = by_particle && pusher < push.pushed;
    OverlapContact contact = shared_by(state, occupancy, swapped ? pusher : push.pushed,
                                       swapped ? grains::as_owner(push.pushed) : push.pusher);
    contact.depth = depth_of(state, occupancy, contact);
    contact.source = push.source;
    result.push_back(contact);
  }
  std::sort(result.begin(), result.end(), [](const OverlapContact& a, const OverlapContact& b) {
    return std::pair(a.first, a.second) < std::pair(b.first, b.second);
  });
  return result;
}

std::vector<double> force_indices(std::size_t particle_count,
                                  const std::vector<OverlapContact>& contacts) {
  std::vector<double> indices(particle_count, 0.0);
  for (const OverlapContact& contact : contacts) {
    const bool second_is_there = !grains::is_particle(contact.second) ||
                                 static_cast<std::size_t>(contact.second) < particle_count;
    if (contact.first >= particle_count || !second_is_there) {
      throw std::invalid_argument("a contact is of a particle that is not there");
    }
    indices[contact.first] += contact.sites;
    if (grains::is_particle(contact.second)) {
      indices[static_cast<std::size_t>(contact.second)] += contact.sites;
    }
  }
  return indices;
}

}  // namespace clca::measure
