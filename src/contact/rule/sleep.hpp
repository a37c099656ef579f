#pragma once
// Sleep: steps leave out grains that have come to rest, until something disturbs them.
//
// A sleeper has no velocity and is a body of infinite mass to those that are awake. Contacts
// between sleepers, and of sleepers with walls, keep their impulses and are not solved.

#include <cstdint>

#include "clca/contact/state.hpp"
#include "contact/rule/step.hpp"

namespace clca::contact {

inline constexpr std::uint8_t kAsleep = 8;
inline constexpr std::uint8_t kDisturbed = 9;  ///< asleep, to be woken at the next check

inline bool is_asleep(const Sleep& sleep, std::size_t id) {
  return !sleep.rests.empty() && sleep.rests[id] >= kAsleep;
}
/// A wall sleeps always.
inline bool both_asleep(const Sleep& sleep, std::uint32_t upper, grains::Owner other) {
  return is_asleep(sleep, upper) &&
         (!grains::is_particle(other) || is_asleep(sleep, static_cast<std::size_t>(other)));
}

/// Coefficients of a contact.
const Pair& coefficients(const grains::State& grains, const Sleep& sleep, const Bodies& bodies,
                         std::uint32_t upper, grains::Owner other);

/// Something that a body touches has moved, or come.
inline void disturb(Sleep& sleep, grains::Owner body) {
  if (grains::is_particle(body) && is_asleep(sleep, static_cast<std::size_t>(body))) {
    sleep.rests[static_cast<std::size_t>(body)] = kDisturbed;
  }
}

/// Checks who falls asleep and who wakes, before the first step and whenever contacts are put in
/// order. A grain that has touched something, has not moved and has at most a quarter of the
/// velocity that gravity gives in a step, at kAsleep checks in a row, falls asleep. It wakes if it
/// has been disturbed, or if the impulses on it and its weight are out of balance by more than its
/// weight and an eighth of the impulses. Nobody sleeps while a wall or the vessel moves.
void check_sleep(State& state, const Rule& rule);

/// Wakes all.
void wake_all(State& state);

}  // namespace clca::contact
