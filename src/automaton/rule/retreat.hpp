#pragma once
// Where a particle may go that overlaps with others but is not pushed itself.

#include <optional>

#include "automaton/rule/world.hpp"

namespace clca::automaton {

/// Whether it may go that way by itself: into free sites, deeper into nobody.
bool is_free(World& world, std::uint32_t id, lattice::Direction direction);

/// Where a particle goes that has pushed others, some of which rest: back from all of those,
/// within 60 degrees, into free sites; kRest when it cannot. None: no such partner rests, it may go
/// as it likes.
std::optional<grains::Move> retreat(World& world, std::uint32_t id);

}  // namespace clca::automaton
