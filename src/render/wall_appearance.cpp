#include "render/wall_appearance.hpp"

#include <algorithm>

namespace clca::render {

bool moves(const grains::Wall& wall) {
  return wall.present && wall.motion.has_value();
}

bool any_wall_moves(const grains::State& state) {
  return std::any_of(state.walls.begin(), state.walls.end(), moves);
}

}  // namespace clca::render
