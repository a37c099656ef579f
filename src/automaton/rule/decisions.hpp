#pragma once
// The decisions about particles in a step, for Reference and Engine.

#include <cstdint>
#include <span>

#include "automaton/rule/active_rule.hpp"
#include "automaton/rule/world.hpp"

namespace clca::automaton {

/// The provisional direction of a particle, from the state as it is.
grains::Move provisional(const World& world, const ActiveRule& active, std::uint32_t id);

/// The turn of a particle that something had been pushed onto when it chose: moves it that way and
/// records whom it pushes, if that is still allowed. False: it cannot.
bool move_pushed(World& world, std::uint32_t id, lattice::Direction direction);

/// The turn of a particle that nothing had been pushed onto when it chose: it moves if it still
/// can. False: it cannot.
bool move_by_itself(World& world, std::uint32_t id, lattice::Direction direction);

/// Whether the particle would share no site with `owner` after one of these moves.
bool can_leave(const World& world, const grains::Particle& particle, grains::Owner owner,
               std::span<const lattice::Direction> directions);

}  // namespace clca::automaton
