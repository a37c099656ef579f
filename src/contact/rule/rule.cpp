#include "contact/rule/rule.hpp"

#include <algorithm>
#include <optional>
#include <stdexcept>

namespace clca::contact {

namespace {

void check(const grains::State& state, const Parameters& parameters) {
  const auto& of_walls = parameters.friction_by_wall;
  const auto is_friction = [](double value) { return value >= 0 && value <= kMaxFriction; };
  const bool walls_sane = std::all_of(
      of_walls.begin(), of_walls.end(),
      [&](std::optional<double> friction) { return !friction || is_friction(*friction); });
  const bool sane = walls_sane && is_friction(parameters.friction) &&
                    is_friction(parameters.wall_friction) &&
                    is_friction(parameters.rolling_friction) && parameters.restitution >= 0 &&
                    parameters.restitution < 1 && parameters.sweeps > 0;
  if (!sane) {
    throw std::invalid_argument("a parameter of the contact model is out of range");
  }
  if (of_walls.size() > state.walls.size()) {
    throw std::invalid_argument("there are more frictions than walls");
  }
  if (parameters.rolling != Rolling::none) {
    for (const grains::Kind& kind : state.kinds) {
      if (!kind.shape.is_round()) {
        throw std::invalid_argument("only hexagons and discs turn: others need Rolling::none");
      }
    }
  }
}

}  // namespace

Rule make_rule(const grains::State& state, const Parameters& parameters, double gravity) {
  check(state, parameters);
  const auto friction = [](double value) { return to_fixed_point(value, kRatioBits); };
  Rule rule = {.gravity = to_fixed_point(gravity, kFractionBits),
               .restitution = to_fixed_point(parameters.restitution, kRatioBits),
               .sweeps = parameters.sweeps,
               .friction = friction(parameters.friction),
               .side_friction = friction(parameters.wall_friction),
               .wall_friction = std::vector<std::int32_t>(state.walls.size(),
                                                          friction(parameters.wall_friction)),
               .law = {.turns = parameters.rolling != Rolling::none,
                       .resists_rolling = parameters.rolling == Rolling::resistance,
                       .rolling_friction = friction(parameters.rolling_friction)},
               .bodies = Bodies(state.kinds)};
  for (std::size_t wall = 0; wall < parameters.friction_by_wall.size(); ++wall) {
    if (const std::optional<double> own = parameters.friction_by_wall[wall]) {
      rule.wall_friction[wall] = friction(*own);
    }
  }
  return rule;
}

}  // namespace clca::contact
