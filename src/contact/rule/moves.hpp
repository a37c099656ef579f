#pragma once
// Motion between contacts: acceleration, remainders, moves of grains and walls by one site.
//
// A remainder is the offset of a grain from its site: where the grain is free to move, at most half
// a spacing along any direction after its moves; where it is held up, at most two
// (collide_blocked).

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "clca/contact/state.hpp"
#include "contact/rule/law.hpp"
#include "contact/rule/touching.hpp"
#include "grains/internal/box.hpp"

namespace clca::contact {

inline constexpr int kCentreBits = 8;        ///< of positions about the centre of turning
inline constexpr int kRateBits = 30;         ///< of angular velocities in radians a step
inline constexpr int kSquaredRateBits = 40;  ///< of squared angular velocities

/// Acceleration in one step; depends on a grain only through position and velocity.
struct Acceleration {
  Vector gravity;                     ///< and shaking, in 2^-23 lattice spacings per step squared
  bool has_centrifugal = false;       ///< the vessel rotates and the box is not periodic
  std::int32_t angular_velocity = 0;  ///< of the vessel, in 2^-30 radians per step
  std::int64_t squared_angular_velocity = 0;  ///< in 2^-40
  std::int32_t centre_x = 0;                  ///< of turning, in 2^-8 lattice spacings
  std::int32_t centre_y = 0;
};

/// The direction of gravity, without shaking.
UnitVector gravity_unit_vector(const Vessel& vessel);

/// `gravity` in 2^-23 lattice spacings per step squared. A periodic box has no centre of rotation:
/// only the direction of gravity turns.
Acceleration acceleration(const Vessel& vessel, std::int32_t gravity, bool periodic);

/// The vessel after a step.
Vessel vessel_after_step(const Vessel& vessel);

/// Accelerates grains in the frame of the vessel: gravity and, if it turns, Coriolis and
/// centrifugal acceleration. `velocity_of(id)`: of a grain.
template <class VelocityOf>
void accelerate_all(const State& state, std::int32_t gravity, VelocityOf velocity_of) {
  const Acceleration by = acceleration(state.vessel, gravity, state.grains.lattice.periodic());
  for (std::uint32_t id = 0; id < state.grains.particles.size(); ++id) {
    const grains::Particle& grain = state.grains.particles[id];
    if (!grain.present) {
      continue;
    }
    Velocity<>& velocity = velocity_of(id);
    std::int64_t x = by.gravity.x;
    std::int64_t y = by.gravity.y;
    if (by.has_centrifugal) {
      const std::int32_t from_centre_x =
          rounded(product(grain.column, unit_vector(lattice::Direction::up_right).x),
                  kUnitBits - kCentreBits) -
          by.centre_x;
      const std::int32_t from_centre_y =
          lattice::doubled_height(grain.site()) * (1 << (kCentreBits - 1)) - by.centre_y;
      constexpr int kBits = kSquaredRateBits + kCentreBits - kFractionBits;
      x += rounded64(product(velocity.y, by.angular_velocity), kRateBits - 1) +
           rounded64(by.squared_angular_velocity * from_centre_x, kBits);
      y += rounded64(by.squared_angular_velocity * from_centre_y, kBits) -
           rounded64(product(velocity.x, by.angular_velocity), kRateBits - 1);
    }
    velocity.x = clamped(velocity.x + x, -kMaxVelocity, kMaxVelocity);
    velocity.y = clamped(velocity.y + y, -kMaxVelocity, kMaxVelocity);
  }
}

/// Subtracts a distance along a unit vector from a remainder.
inline void subtract_along(Vector& remainder, std::int32_t distance, const UnitVector& unit) {
  remainder.x -= rounded(product(distance, unit.x), kUnitBits);
  remainder.y -= rounded(product(distance, unit.y), kUnitBits);
}

inline void subtract_along(Vector& remainder, std::int32_t distance, lattice::Direction direction) {
  subtract_along(remainder, distance, unit_vector(direction));
}

/// Adds a velocity to a remainder. If the grain is at rest (it touches something and its speed is
/// at most `rest_speed`), the remainder decays instead, except its part along gravity: to lift a
/// resting grain would add energy. Returns whether the grain is at rest.
inline bool advance_remainder(Vector& remainder, const Velocity<>& velocity, bool touches,
                              std::int32_t rest_speed, const UnitVector& gravity) {
  constexpr std::int32_t kForgotten = 16;  // a sixteenth in each step
  if (!touches || squared({velocity.x, velocity.y}) > product(rest_speed, rest_speed)) {
    remainder.x = clamped(remainder.x + velocity.x, -kMaxRemainder, kMaxRemainder);
    remainder.y = clamped(remainder.y + velocity.y, -kMaxRemainder, kMaxRemainder);
    return false;
  }
  Vector decaying = remainder;
  subtract_along(decaying, std::max(along(remainder, gravity), 0), gravity);
  remainder.x -= decaying.x / kForgotten;
  remainder.y -= decaying.y / kForgotten;
  return true;
}

/// Calls advance_remainder() for the remainders of all grains. Returns whether all grains are at
/// rest. `touches(id)`: whether a grain touches anything.
template <class VelocityOf, class Touches>
bool advance_remainders(State& state, std::int32_t rest_speed, VelocityOf velocity,
                        Touches touches) {
  const UnitVector gravity = gravity_unit_vector(state.vessel);
  bool at_rest = true;
  for (std::uint32_t id = 0; id < state.grains.particles.size(); ++id) {
    if (state.grains.particles[id].present) {
      at_rest =
          advance_remainder(state.remainders[id], velocity(id), touches(id), rest_speed, gravity) &&
          at_rest;
    }
  }
  return at_rest;
}

/// Whether the remainder is large enough for a move.
inline bool is_move_due(const Vector& remainder, lattice::Direction direction) {
  return along(remainder, unit_vector(direction)) > kSpacing / 2;
}

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

/// Velocities of walls for contacts: of their motions, more if behind; 0 of standing walls.
WallVelocities wall_velocities(const State& state);

/// Advances the motions of walls by a step. Returns the desired move of each moving wall.
std::vector<WallMove> advance_walls(State& state);

/// Order of move directions in a step: down first, up last; of two at one angle by a coin.
std::array<lattice::Direction, lattice::kDirectionCount> direction_order(const grains::State& state,
                                                                         lattice::Direction down);

/// Moves grains and walls by single sites and records the moves.
class SiteMoves {
 public:
  /// Both arguments must outlive this object; the box is that of the state.
  SiteMoves(State& state, grains::Box& box) : state_(state), box_(box) {}

  /// Starts a step: clears the record.
  void begin_step();

  /// An owner that blocks a step of a grain; kFree if there is none.
  grains::Owner blocking_owner(std::uint32_t id, lattice::Direction direction) const;
  /// Moves grains at once, into sites that are free then.
  void move(std::span<const std::uint32_t> ids, lattice::Direction direction);
  /// The grains of `blocked` that can only move at once: each is blocked by others of them alone,
  /// as shapes are that hook into one another.
  std::vector<std::uint32_t> movable_at_once(std::vector<std::uint32_t> blocked,
                                             lattice::Direction direction) const;
  /// Moves the walls that are due in this direction and have not moved yet, with all grains they
  /// push. A wall blocked by the border or another wall stays. Returns whether any wall moved;
  /// appends the pushed grains.
  bool move_walls(lattice::Direction direction, std::span<WallMove> walls,
                  std::vector<std::uint32_t>& pushed);

  /// Ids of grains that moved in this step, without duplicates.
  const std::vector<std::uint32_t>& moved_ids() const { return moved_; }
  /// Whether the anchor of a grain has moved in this step, see State::from_anchors.
  bool anchor_moved() const { return anchor_moved_; }
  /// Grains next to sites that walls entered or left; may have duplicates.
  const std::vector<std::uint32_t>& grains_beside_walls() const { return beside_walls_; }

 private:
  /// The first blocking owner that `chosen` returns true for; kFree if there is none.
  template <class Chosen>
  grains::Owner blocking_owner(std::uint32_t id, lattice::Direction direction, Chosen chosen) const;
  /// Takes a step of a wall with all grains that it pushes. Returns false if that is blocked.
  bool push_grains(const grains::WallStep& step, std::vector<std::uint32_t>& pushed);
  void note_neighbours(const std::vector<std::size_t>& indices);

  State& state_;
  grains::Box& box_;
  std::vector<std::uint32_t> moved_;
  std::vector<std::uint32_t> beside_walls_;
  bool anchor_moved_ = false;
};

/// Moves each grain by one site in every direction in which its remainder is large enough and the
/// sites are free; chains of grains move at once.
/// Walls make their moves; grains they pushed may still move in later directions. `down`: lattice
/// direction nearest to gravity.
void move_all(SiteMoves& moves, State& state, lattice::Direction down, std::span<WallMove> walls);

/// Shortens remainders to two spacings along any direction. Where a remainder is cut and the grain
/// approaches what is in its way, the two collide along that direction, without restitution and
/// friction: with several such collisions of a body each gets a share of its mass, so that the
/// order does not matter, momentum is conserved, and no energy is gained. Where nothing is in the
/// way, the grain is faster than it can move: it loses velocity with the distance. `ids`: grains
/// whose remainders may be that long, each once, in any order. Sets the members of `step`.
void collide_blocked(State& state, const SiteMoves& moves, const BodyVelocities& bodies,
                     std::span<const std::uint32_t> ids, LastStep& step);

/// Whether no wall will move while no grain does: each has finished or has been blocked for the
/// settling time, so that its push no longer grows.
bool walls_are_at_rest(const State& state);

}  // namespace clca::contact
