#pragma once
// Sleep: steps skip grains that have come to rest until something disturbs them.
// A sleeping grain has no velocity and infinite mass for awake grains. Contacts among sleeping
// grains and walls keep their impulses and are not solved.

#include <cstdint>

#include "clca/contact/state.hpp"
#include "contact/rule/step.hpp"

namespace clca::contact {

inline constexpr std::uint8_t kAsleep = 8;
inline constexpr std::uint8_t kDisturbed = 9;  ///< asleep, to be woken at the next check

inline bool is_asleep(const Sleep& sleep, std::size_t id) {
  return !sleep.rests.empty() && sleep.rests[id] >= kAsleep;
}
/// Walls always count as asleep.
inline bool both_asleep(const Sleep& sleep, std::uint32_t upper, grains::Owner other) {
  return is_asleep(sleep, upper) &&
         (!grains::is_particle(other) || is_asleep(sleep, static_cast<std::size_t>(other)));
}

/// Coefficients of a contact.
const Pair& coefficients(const grains::State& grains, const Sleep& sleep, const Bodies& bodies,
                         std::uint32_t upper, grains::Owner other);

/// Marks a body as disturbed: something that it touches has moved or appeared.
inline void disturb(Sleep& sleep, grains::Owner body) {
  if (grains::is_particle(body) && is_asleep(sleep, static_cast<std::size_t>(body))) {
    sleep.rests[static_cast<std::size_t>(body)] = kDisturbed;
  }
}

/// Puts grains to sleep and wakes them; before the first step and whenever contacts are sorted.
/// A grain falls asleep after kAsleep consecutive checks with a contact, without a move and with at
/// most a quarter of the velocity that gravity gives in a step.
/// It wakes if disturbed, or if its impulses and weight are out of balance by more than its weight
/// plus an eighth of the impulses. No grain sleeps while a wall or the vessel moves.
void check_sleep(State& state, const Rule& rule);

/// Wakes all grains.
void wake_all(State& state);

}  // namespace clca::contact
