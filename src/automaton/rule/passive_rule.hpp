#pragma once
// The passive rule: where a particle goes that something has been pushed onto (Sakaguchi et al.
// 2001, Fig. 8, after Murakami).

#include "automaton/rule/world.hpp"

namespace clca::automaton {

/// The best direction of a particle onto which others were pushed; kRest: it is jammed.
grains::Move passive_direction(const World& world, std::uint32_t id);

/// Moves the particle that way and records whom it pushes, if that is still allowed at its turn.
bool move_pushed(World& world, std::uint32_t id, lattice::Direction direction);

}  // namespace clca::automaton
