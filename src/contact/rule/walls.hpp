#pragma once
// Walls that move: bodies of infinite mass that go along with their motions where they can.

#include <cstdint>
#include <span>
#include <vector>

#include "clca/contact/state.hpp"

namespace clca::contact {

/// Steps in a row without any motion after which a state counts as settled.
inline constexpr std::uint64_t kQuietSteps = 60;

/// What a wall wants in a step and what comes of it.
struct WallMove {
  std::size_t wall = 0;
  int wished = 0;  ///< +1 along its motion, -1 against it, 0 none
  bool done = false;

  lattice::Direction direction(const grains::State& state) const {
    const lattice::Direction forward = state.walls[wall].motion->direction;
    return wished > 0 ? forward : opposite(forward);
  }
};

/// The velocity that grains feel of a wall in this step: that of its motion, and more where it has
/// been held up; 0 of one that stands.
Velocity<std::int32_t> wall_velocity(const State& state, std::size_t wall);

/// Lets the motions of walls go on by a step. Returns what each wall in motion wants now.
std::vector<WallMove> advance_walls(State& state);

/// Ends a step: accounts for the moves of walls, and the vessel goes on. `quiet`: nothing has moved
/// but perhaps walls, and no grain has more than the velocity that counts as rest.
void end_step(State& state, std::span<const WallMove> walls, bool quiet);

/// Whether a wall is on its way, be it held up.
bool walls_move(const State& state);

/// Whether no wall will ever move while no grain does: each has come to its end, or has been held
/// up for as long as a state takes to settle, and pushes as hard as it ever will.
bool walls_rest(const State& state);

}  // namespace clca::contact
