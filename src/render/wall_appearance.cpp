#include "render/wall_appearance.hpp"

#include <algorithm>

namespace clca::render {

bool moves(const grains::Wall& wall) {
  return wall.present && wall.motion.has_value();
}

bool any_wall_moves(const grains::State& state) {
  return std::any_of(state.walls.begin(), state.walls.end(), moves);
}

WallsAppearance::WallsAppearance(const grains::State& state) {
  for (const grains::Wall& wall : state.walls) {
    walls_.push_back(wall.present
                         ? WallAppearance{true, wall.motion.has_value(), wall.shift(), wall.sites}
                         : WallAppearance{});
  }
}

bool WallsAppearance::match(const grains::State& state) const {
  return std::equal(
      walls_.begin(), walls_.end(), state.walls.begin(), state.walls.end(),
      [](const WallAppearance& seen, const grains::Wall& wall) { return seen.looks_like(wall); });
}

bool WallsAppearance::WallAppearance::looks_like(const grains::Wall& wall) const {
  if (!present || !wall.present) {
    return present == wall.present;
  }
  return moving == wall.motion.has_value() && shift == wall.shift() && sites == wall.sites;
}

}  // namespace clca::render
