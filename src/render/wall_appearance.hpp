#pragma once
// How walls look in a picture.

#include "clca/grains/state.hpp"

namespace clca::render {

/// Whether the wall is present and has a motion.
bool moves(const grains::Wall& wall);
/// Whether some present wall has a motion.
bool any_wall_moves(const grains::State& state);

}  // namespace clca::render
