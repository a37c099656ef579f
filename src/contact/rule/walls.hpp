#pragma once
// Moving walls: bodies of infinite mass that follow their motions if possible.

#include <cstdint>
#include <span>
#include <vector>

#include "clca/contact/state.hpp"

namespace clca::contact {

/// Consecutive steps without motion after which a state counts as settled.
inline constexpr std::uint64_t kQuietSteps = 60;

/// The desired move of a wall in a step and whether it was done.
struct WallMove {
  std::size_t wall = 0;
  int desired = 0;  ///< +1 along its motion, -1 against it, 0 none
  bool done = false;

  lattice::Direction direction(const grains::State& state) const {
    const lattice::Direction forward = state.walls[wall].motion->direction;
    return desired > 0 ? forward : opposite(forward);
  }
};

/// Velocity of a wall for contacts: that of its motion, more if it lags behind; 0 for a standing
/// wall.
Velocity<std::int32_t> wall_velocity(const State& state, std::size_t number);

/// By wall.
using WallVelocities = std::vector<Velocity<std::int32_t>>;
WallVelocities wall_velocities(const State& state);

/// Advances the motions of walls by a step. Returns the desired move of each moving wall.
std::vector<WallMove> advance_walls(State& state);

/// Whether any grain moved by a site in a step, and whether an anchor of one did.
struct GrainMoves {
  bool moved = false;
  bool advanced = false;
};

/// Ends a step: updates walls and vessel. `at_rest`: no grain is faster than the rest limit.
void end_step(State& state, std::span<const WallMove> walls, GrainMoves grains, bool at_rest);

/// Counts from here on: something may move again.
void disturb(State& state);

/// Whether grains have come to rest. `slow`: the rest limit. Grains that are faster for long
/// without going anywhere are held up, though their contacts let them go on, or hop to and fro.
bool grains_rest(const State& state, std::int32_t slow);

/// Whether no wall will move while no grain does: each has finished or has been blocked for the
/// settling time, so that its push no longer grows.
bool walls_rest(const State& state);

}  // namespace clca::contact
