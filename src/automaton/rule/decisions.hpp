#pragma once
// The decisions about particles in a step, for Reference and Engine.

#include <cstdint>

#include "automaton/rule/active_rule.hpp"
#include "automaton/rule/world.hpp"

namespace clca::automaton {

/// The provisional direction of a particle, from the state as it is.
grains::Move provisional(const World& world, const ActiveRule& active, std::uint32_t id);

/// The turn of a particle that nothing had been pushed onto when it chose: it moves if it still
/// can. False: it cannot.
bool move_by_itself(World& world, std::uint32_t id, lattice::Direction direction);

}  // namespace clca::automaton
