#pragma once
// Acceleration of grains between contacts: gravity and the inertial forces in a moving vessel.

#include <cstdint>

#include "clca/contact/state.hpp"
#include "clca/contact/vessel.hpp"
#include "clca/lattice/direction.hpp"
#include "clca/lattice/lattice.hpp"
#include "contact/rule/remainders.hpp"

namespace clca::contact {

inline constexpr int kCentreBits = 8;        ///< of positions about the centre of turning
inline constexpr int kRateBits = 30;         ///< of angular velocities in radians a step
inline constexpr int kCentrifugalBits = 40;  ///< of their squares

/// Acceleration in one step; depends on a grain only through position and velocity.
struct Acceleration {
  Vector gravity;  ///< and shaking, in 2^-23 lattice spacings per step squared
  bool turns = false;
  std::int32_t rate = 0;  ///< angular velocity of the vessel
  std::int64_t squared_rate = 0;
  std::int32_t centre_x = 0;
  std::int32_t centre_y = 0;
};

/// The direction of gravity, without shaking.
UnitVector gravity_unit(const Vessel& vessel);

/// `gravity` in 2^-23 lattice spacings per step squared. A periodic box has no centre of rotation:
/// only the direction of gravity turns.
Acceleration acceleration(const Vessel& vessel, std::int32_t gravity, bool periodic);

/// The vessel after a step.
Vessel next(const Vessel& vessel);

/// Accelerates a grain in the frame of the vessel: gravity and, if it turns, Coriolis and
/// centrifugal acceleration.
inline void accelerate(Velocity<std::int32_t>& velocity, lattice::Site site,
                       const Acceleration& by) {
  std::int64_t x = by.gravity.x;
  std::int64_t y = by.gravity.y;
  if (by.turns) {
    const std::int32_t from_centre_x =
        rounded(product(site.column, unit_of(lattice::Direction::up_right).x),
                kUnitBits - kCentreBits) -
        by.centre_x;
    const std::int32_t from_centre_y =
        lattice::doubled_height(site) * (1 << (kCentreBits - 1)) - by.centre_y;
    constexpr int kBits = kCentrifugalBits + kCentreBits - kFractionBits;
    x += scaled(product(velocity.y, by.rate), kRateBits - 1) +
         scaled(by.squared_rate * from_centre_x, kBits);
    y += scaled(by.squared_rate * from_centre_y, kBits) -
         scaled(product(velocity.x, by.rate), kRateBits - 1);
  }
  velocity.x = clamped(velocity.x + x, -kMaxVelocity, kMaxVelocity);
  velocity.y = clamped(velocity.y + y, -kMaxVelocity, kMaxVelocity);
}

}  // namespace clca::contact
