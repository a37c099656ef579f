#pragma once
// Walls that come and go between stages.

#include "automaton/world.hpp"

namespace clca::automaton {

/// See Automaton::remove_wall.
void remove_wall(World& world, std::size_t number);
/// See Automaton::insert_wall.
bool insert_wall(World& world, std::size_t number);

}  // namespace clca::automaton
