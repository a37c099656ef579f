#include "contact/rule/walls.hpp"

#include <algorithm>
#include <cstdlib>

#include "contact/rule/acceleration.hpp"
#include "contact/rule/numbers.hpp"
#include "contact/rule/remainders.hpp"

namespace clca::contact {

namespace {

bool in_motion(const grains::Wall& wall) {
  return wall.motion && wall.present && wall.travel.active;
}

// A wall behind its motion adds 1/16 of the lag per step to its velocity, at most half a spacing
// (units of grains::kMotionSpacing).
// A weaker push is lost in the bed, which two sweeps make elastic: with 1/64 and 1/8 spacing, walls
// took two to four times as long.
constexpr std::int64_t kLagSteps = 16;
constexpr std::int64_t kMaxCatchUp = grains::kMotionSpacing / 2;

/// `speed`: of the motion; if that has ended, the wall still has to arrive.
std::int64_t haste(std::int64_t lag, std::int32_t speed) {
  const std::int64_t least = speed == 0 ? grains::kMotionSpacing / 2 : grains::kMotionSpacing;
  return std::abs(lag) > least ? std::clamp(lag / kLagSteps, -kMaxCatchUp, kMaxCatchUp) : 0;
}

}  // namespace

Velocity<std::int32_t> wall_velocity(const State& state, std::size_t number) {
  const grains::Wall& wall = state.grains.walls[number];
  if (!in_motion(wall)) {
    return {};
  }
  const std::int64_t lag = state.wall_remainders[number];
  constexpr auto kUnit = static_cast<std::int32_t>(kSpacing / grains::kMotionSpacing);
  const std::int32_t own = grains::velocity(*wall.motion, wall.travel, lag);
  const std::int32_t speed = kUnit * (own + static_cast<std::int32_t>(haste(lag, own)));
  const UnitVector& unit = unit_of(wall.motion->direction);
  return {.x = rounded(product(speed, unit.x), kUnitBits),
          .y = rounded(product(speed, unit.y), kUnitBits)};
}

WallVelocities wall_velocities(const State& state) {
  WallVelocities result;
  for (std::size_t wall = 0; wall < state.grains.walls.size(); ++wall) {
    result.push_back(wall_velocity(state, wall));
  }
  return result;
}

std::vector<WallMove> advance_walls(State& state) {
  std::vector<WallMove> result;
  for (std::size_t number = 0; number < state.grains.walls.size(); ++number) {
    const grains::Wall& wall = state.grains.walls[number];
    if (!in_motion(wall)) {
      continue;
    }
    std::int64_t& ahead = state.wall_remainders[number];
    ahead += grains::velocity(*wall.motion, wall.travel, ahead);
    result.push_back({.wall = number,
                      .desired = (ahead > grains::kMotionSpacing / 2 ? 1 : 0) -
                                 (ahead < -grains::kMotionSpacing / 2 ? 1 : 0)});
  }
  return result;
}

void end_step(State& state, std::span<const WallMove> walls, GrainMoves grains, bool at_rest) {
  bool walls_moved = state.vessel.moves();
  for (const WallMove& move : walls) {
    grains::Wall& wall = state.grains.walls[move.wall];
    std::int64_t& ahead = state.wall_remainders[move.wall];
    ahead -= move.done ? move.desired * grains::kMotionSpacing : 0;
    take_step(*wall.motion, wall.travel, move.desired, move.done, state.grains.step, ahead);
    walls_moved = walls_moved || move.done;
  }
  state.unmoved_steps = walls_moved || grains.advanced ? 0 : state.unmoved_steps + 1;
  state.quiet_steps = walls_moved || grains.moved || !at_rest ? 0 : state.quiet_steps + 1;
  for (const WallMove& move : walls) {
    grains::Wall& wall = state.grains.walls[move.wall];
    grains::end_step(*wall.motion, wall.travel, state.quiet_steps < kQuietSteps);
  }
  const lattice::Direction before = down(state.vessel);
  state.vessel = next(state.vessel);
  state.changed = state.changed || down(state.vessel) != before;
  ++state.grains.step;
}

void disturb(State& state) {
  state.unmoved_steps = 0;
  state.quiet_steps = 0;
}

bool grains_rest(const State& state, std::int32_t slow) {
  // A remainder grows from -2 to 1/2 along some direction at most 30 degrees off before it moves.
  constexpr std::int64_t kFarthest = std::int64_t{3} * kSpacing;
  return state.quiet_steps >= kQuietSteps ||
         (slow > 0 && state.unmoved_steps >=
                          std::max(kQuietSteps, static_cast<std::uint64_t>(kFarthest / slow)));
}

bool walls_rest(const State& state) {
  for (std::size_t number = 0; number < state.grains.walls.size(); ++number) {
    const grains::Wall& wall = state.grains.walls[number];
    if (!in_motion(wall) || is_over(*wall.motion, wall.travel)) {
      continue;
    }
    const std::int64_t lag = state.wall_remainders[number];
    const std::int32_t own = grains::velocity(*wall.motion, wall.travel, lag);
    const bool pushes_no_harder = own == 0 || std::abs(haste(lag, own)) == kMaxCatchUp;
    const bool held_up = wall.travel.stalled_since &&
                         state.grains.step - *wall.travel.stalled_since >= kQuietSteps &&
                         pushes_no_harder;
    if (!held_up) {
      return false;
    }
  }
  return true;
}

}  // namespace clca::contact
